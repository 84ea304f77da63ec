// SPDX-License-Identifier: AGPL-3.0-or-later
// Pipes over the ends of rods and tubes of two millimetres a unit.
#include "geometry/pipe_zone.h"

#include <cmath>
#include <cstring>

#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>

#include "tests/geometry/hand_solids.hpp"
#include "tests/geometry/hand_tube.hpp"
#include "tests/unit_test.h"

static const CwPipeZoneNames names = {"suction", "pipe", "shaft", "to_tube", "to_pipe"};
static const double unit = 2e-3;

static CwSolid *pipe_at(CwSolid *neighbour, const char *end, double length) {
  CwSolid *pipe = nullptr;
  if (cw_pipe_zone_make(neighbour, end, length, &names, &pipe) != CW_OK) fail_msg("%s", cw_fail_message());
  assert_string_equal(cw_solid_fault(*pipe).c_str(), "");
  assert_near(hand_edge_tolerance(*pipe), 1e-5, 0);
  return pipe;
}

static void expect_faces(const CwSolid &solid, const char *patch, CwPatchKind kind, int count) {
  int found = 0;
  for (const CwSolidFace &face : solid.faces) {
    if (face.patch != patch) continue;
    assert_int_equal(face.kind, kind);
    const std::string name = patch + (count > 1 ? "_" + std::to_string(++found) : std::string());
    if (count == 1) found++;
    assert_string_equal(face.name.c_str(), name.c_str());
  }
  if (found != count) fail_msg("%d faces of %s in place of %d", found, patch, count);
}

// Over either end of a rod of radius 5 and over the ring of a tube of radii 2 and 5, 40 mm long: 20 units.
static void prisms_over_both_ends(void **) {
  for (const double inner : {0., 2.})
    for (const bool into : {false, true})
      for (const bool outlet : {false, true}) {
        const int sectors = 3, ends = inner > 0 ? sectors : 1;
        const char *end = outlet ? "outlet" : "inlet";
        const CwPatchKind kind = outlet ? CW_PATCH_OUTLET : CW_PATCH_INLET;
        CwSolid *tube = hand_tube({inner, 5, 7, sectors, into}, unit), *pipe = pipe_at(tube, end, 0.04);
        const double section = M_PI * (25 - inner * inner);
        assert_near(hand_volume(pipe->solid), section * 20, 1e-6 * section);
        assert_string_equal(pipe->domain.c_str(), "suction");
        assert_near(pipe->unit, unit, 0);
        assert_int_equal(pipe->faces.size(), 2 * ends + sectors * (inner > 0 ? 2 : 1));
        expect_faces(*pipe, "pipe", CW_PATCH_WALL, sectors);
        expect_faces(*pipe, "shaft", CW_PATCH_WALL, inner > 0 ? sectors : 0);
        expect_faces(*pipe, "to_tube", CW_PATCH_INTERFACE, ends);
        expect_faces(*pipe, end, kind, ends); // as the tube had it
        expect_faces(*tube, "to_pipe", CW_PATCH_INTERFACE, ends);
        expect_faces(*tube, end, kind, 0);
        expect_faces(*tube, outlet ? "inlet" : "outlet", outlet ? CW_PATCH_INLET : CW_PATCH_OUTLET, ends);
        assert_near(hand_patch_area(*pipe, "pipe"), 2 * M_PI * 5 * 20, 1e-4);
        assert_near(hand_patch_area(*pipe, "shaft"), 2 * M_PI * inner * 20, 1e-4);
        assert_near(hand_patch_area(*pipe, "to_tube"), section, 1e-6);
        for (const CwSolidFace &face : pipe->faces) {
          const double z = hand_centre(face.face).Z(), from = outlet ? 7 : 0, to = outlet ? 27 : -20;
          assert_near(z, face.patch == "to_tube" ? from : face.patch == end ? to : (from + to) / 2, 1e-9);
        }
        cw_solid_free(&pipe);
        cw_solid_free(&tube);
      }
}

// Ends and middles of the outlines of a patch's faces.
static std::vector<gp_Pnt> outline(const CwSolid &solid, const char *patch) {
  std::vector<gp_Pnt> points;
  for (const CwSolidFace &face : solid.faces)
    for (TopExp_Explorer at(face.face, TopAbs_EDGE); at.More() && face.patch == patch; at.Next()) {
      double first, last;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(at.Current()), first, last);
      for (const double s : {0.0, 0.5, 1.0}) points.push_back(curve->Value(first + s * (last - first)));
    }
  return points;
}

// Both sides of the disc have the same outline, to the last bit, wherever the tube stands.
static void both_sides_have_one_outline(void **) {
  gp_Trsf turn, move;
  turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 2, 2)), 0.7);
  move.SetTranslation(gp_Vec(0.1, -50, 3));
  for (const double inner : {0., 2.}) {
    CwSolid *tube = hand_tube({inner, 5, 7, 4}, unit, move * turn), *pipe = pipe_at(tube, "outlet", 0.04);
    const std::vector<gp_Pnt> one = outline(*tube, "to_pipe"), other = outline(*pipe, "to_tube");
    assert_int_equal(one.size(), other.size());
    assert_true(one.size() >= 12);
    for (const gp_Pnt &point : one) {
      double least = INFINITY;
      for (const gp_Pnt &at : other) least = std::fmin(least, at.Distance(point));
      assert_near(least, 0, 0);
    }
    const gp_Vec axis(gp_Vec(0, 0, 1).Transformed(turn));
    const gp_Pnt far = gp_Pnt(0, 0, 27).Transformed(move * turn);
    double worst = 0;
    for (const CwSolidFace &face : pipe->faces)
      if (face.patch == "outlet") worst = std::fmax(worst, std::fabs(gp_Vec(far, hand_centre(face.face)).Dot(axis)));
    assert_near(worst, 0, 1e-9);
    cw_solid_free(&pipe);
    cw_solid_free(&tube);
  }
}

// A third of a unit is brought to a multiple of 2^-26, as similar pumps of any size have it.
static void lengths_are_rounded(void **) {
  CwSolid *tube = hand_tube({0, 5, 8, 2}, unit), *pipe = pipe_at(tube, "outlet", unit / 3);
  int found = 0;
  for (const gp_Pnt &point : outline(*pipe, "outlet")) {
    const double length = (point.Z() - 8) * 0x1p26;
    assert_near(length, std::round(0x1p26 / 3), 0);
    found++;
  }
  assert_true(found > 0);
  cw_solid_free(&pipe);
  cw_solid_free(&tube);
}

static void ends_that_are_none(void **) {
  CwSolid *tube = hand_tube({0, 5, 7, 2}, unit), *pipe = tube;
  assert_int_equal(cw_pipe_zone_make(tube, "eye", 0.04, &names, &pipe), CW_ERR_GEOMETRY);
  assert_string_equal(cw_fail_message(), "suction: no patch eye");
  assert_null(pipe);
  assert_int_equal(cw_pipe_zone_make(tube, "wall", 0.04, &names, &pipe), CW_ERR_GEOMETRY);
  assert_string_equal(cw_fail_message(), "suction: patch wall is not flat");
  assert_null(pipe);
  cw_fail_clear();
  expect_faces(*tube, "wall", CW_PATCH_WALL, 2); // as before
  cw_solid_free(&tube);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(prisms_over_both_ends),
      cmocka_unit_test(both_sides_have_one_outline),
      cmocka_unit_test(lengths_are_rounded),
      cmocka_unit_test(ends_that_are_none),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
