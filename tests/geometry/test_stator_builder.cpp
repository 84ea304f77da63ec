// SPDX-License-Identifier: AGPL-3.0-or-later
// Rods, tubes and blocks by loops of edges: senses, names and curves in the parameter planes follow by themselves.
#include "geometry/stator_builder.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>

#include <Geom_ConicalSurface.hxx>
#include <gp_Ax1.hxx>

#include "geometry/bspline_fit.hpp"
#include "tests/geometry/hand_solids.hpp"
#include "tests/geometry/hand_tube.hpp"
#include "tests/unit_test.h"

static const CwSolidFace &named(const CwSolid &solid, const std::string &name) {
  for (const CwSolidFace &face : solid.faces)
    if (face.name == name) return face;
  fail_msg("no face %s", name.c_str());
  return solid.faces[0];
}

// Whatever edge a loop begins at and however it runs: pi (R^2 - r^2) L, and no tolerance but the least.
static void rods_and_tubes(void **) {
  const HandTube tubes[] = {{0, 5, 7, 2}, {0, 5, 7, 5}, {2, 5, 7, 3}, {4.9, 5, 0.5, 2}};
  for (HandTube tube : tubes)
    for (int way = 0; way < 4; way++) {
      tube.turned = way;
      tube.into = way == 2;
      CwSolid *solid = hand_tube(tube, 2e-3);
      const double volume = M_PI * (tube.outer * tube.outer - tube.inner * tube.inner) * tube.length;
      const int rims = tube.inner > 0 ? 2 : 1;
      assert_string_equal(cw_solid_fault(*solid).c_str(), "");
      assert_near(hand_volume(solid->solid), volume, 1e-6 * volume);
      assert_near(hand_edge_tolerance(*solid), 1e-5, 0);
      assert_near(solid->unit, 2e-3, 0);
      assert_string_equal(solid->domain.c_str(), "tube");
      assert_true(hand_faces_in_order(*solid));
      assert_int_equal(hand_patch_count(*solid, "wall"), tube.sectors);
      assert_int_equal(hand_patch_count(*solid, "core"), rims == 2 ? tube.sectors : 0);
      assert_int_equal(hand_patch_count(*solid, "inlet"), rims == 2 ? tube.sectors : 1);
      assert_near(hand_patch_area(*solid, "wall"), 2 * M_PI * tube.outer * tube.length, 1e-6 * volume);
      assert_near(hand_patch_area(*solid, "core"), 2 * M_PI * tube.inner * tube.length, 1e-6 * volume);
      cw_solid_free(&solid);
    }
}

// A patch of several faces numbers them in their order, one of a single face has its name.
static void faces_are_named_by_their_patch(void **) {
  CwSolid *solid = hand_tube({0, 5, 7, 3}, 1);
  for (int i = 0; i < 3; i++) {
    const CwSolidFace &wall = named(*solid, "wall_" + std::to_string(i + 1));
    const gp_Pnt at = hand_centre(wall.face);
    assert_near(atan2(at.Y(), at.X()), std::remainder((i + 0.5) * 2 * M_PI / 3, 2 * M_PI), 1e-6);
    assert_int_equal(wall.kind, CW_PATCH_WALL);
  }
  assert_near(hand_centre(named(*solid, "inlet").face).Z(), 0, 1e-9);
  assert_near(hand_centre(named(*solid, "outlet").face).Z(), 7, 1e-9);
  assert_int_equal(named(*solid, "inlet").kind, CW_PATCH_INLET);
  assert_int_equal(named(*solid, "outlet").kind, CW_PATCH_OUTLET);
  cw_solid_free(&solid);
}

// Which side is the fluid's follows from the first face alone.
static void the_first_face_says_what_is_outside(void **) {
  LoopBuilder builder(PLANE_CURVE, 1);
  hand_tube_faces(builder, {0, 5, 7, 2});
  CwSolid *solid = builder.build("inside out", gp_Trsf(), true); // the normal of z = 0 points up, into the rod
  assert_near(hand_volume(solid->solid), -M_PI * 25 * 7, 1e-4);
  cw_solid_free(&solid);
}

// Turned by 90 degrees about the x axis, then raised by 100: the far end lies at y = -7.
static void a_motion_moves_all(void **) {
  gp_Trsf turn, raise;
  turn.SetRotation(gp_Ax1(gp::Origin(), gp::DX()), M_PI / 2);
  raise.SetTranslation(gp_Vec(0, 0, 100));
  CwSolid *solid = hand_tube({2, 5, 7, 4}, 1, raise * turn);
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid->solid, properties);
  assert_string_equal(cw_solid_fault(*solid).c_str(), "");
  assert_near(hand_edge_tolerance(*solid), 1e-5, 0); // the least: edges have gone with their faces
  assert_near(properties.Mass(), M_PI * 21 * 7, 1e-4);
  assert_near(properties.CentreOfMass().Distance(gp_Pnt(0, -3.5, 100)), 0, 1e-6);
  for (const CwSolidFace &face : solid->faces)
    if (face.patch == "outlet") assert_near(hand_centre(face.face).Y(), -7, 1e-9);
  cw_solid_free(&solid);
}

// A frustum of radii 4 and 2, 6 high, as two halves of a cone: pi 6 (16 + 8 + 4) / 3. With the borders of its faces in
// the parameter plane given, and without.
static void cones(void **) {
  const double slope = atan2(-2, 6), slant = std::hypot(2, 6);
  for (const bool given : {false, true}) {
    LoopBuilder builder(PLANE_CURVE, 1);
    int v[2][2], arc[2][2], side[2];
    for (int end = 0; end < 2; end++)
      for (int k = 0; k < 2; k++) v[end][k] = builder.vertex(gp_Pnt((k ? -1 : 1) * (end ? 2 : 4), 0, 6 * end));
    for (int end = 0; end < 2; end++)
      for (int k = 0; k < 2; k++) arc[end][k] = builder.arc(v[end][k], v[end][1 - k], M_PI);
    for (int k = 0; k < 2; k++) side[k] = builder.line(v[0][k], v[1][k]);
    for (int end = 0; end < 2; end++)
      builder.face(new Geom_Plane(gp_Ax3(gp_Pnt(0, 0, 6 * end), gp::DZ())), {arc[end][0], arc[end][1]}, "end");
    for (int k = 0; k < 2; k++) {
      const double from = k * M_PI - U_MARGIN, u0 = U_MARGIN, u1 = U_MARGIN + M_PI;
      const Handle(Geom_Surface) cone =
          new Geom_ConicalSurface(gp_Ax3(gp::Origin(), gp::DZ(), gp_Dir(cos(from), sin(from), 0)), slope, 4);
      if (given)
        builder.face(cone,
                     {{arc[0][k], u0, 0, u1, 0},
                      {side[1 - k], u1, 0, u1, slant},
                      {arc[1][k], u0, slant, u1, slant},
                      {side[k], u0, 0, u0, slant}},
                     "cone");
      else
        builder.face(cone, {arc[0][k], side[1 - k], arc[1][k], side[k]}, "cone");
    }
    CwSolid *solid = builder.build("frustum", gp_Trsf(), false);
    assert_string_equal(cw_solid_fault(*solid).c_str(), "");
    assert_near(hand_volume(solid->solid), 56 * M_PI, 1e-5);
    assert_near(hand_patch_area(*solid, "cone"), M_PI * 6 * slant, 1e-5);
    cw_solid_free(&solid);
  }
}

// A cube of 2 whose top is a spline surface: with all of its borders given, or else refused.
static CwSolid *cube_with_free_top(bool given) {
  LoopBuilder builder(PLANE_CURVE, 1);
  int v[8], low[4], high[4], up[4];
  for (int k = 0; k < 8; k++)
    v[k] = builder.vertex(gp_Pnt(k % 4 == 1 || k % 4 == 2 ? 2 : 0, k % 4 > 1 ? 2 : 0, k / 4 * 2));
  for (int k = 0; k < 4; k++) {
    low[k] = builder.line(v[k], v[(k + 1) % 4]);
    high[k] = builder.line(v[4 + k], v[4 + (k + 1) % 4]);
    up[k] = builder.line(v[k], v[4 + k]);
  }
  builder.face(new Geom_Plane(gp_Ax3(gp::Origin(), gp::DZ())), {low[0], low[1], low[2], low[3]}, "wall");
  for (int k = 0; k < 4; k++) {
    const gp_Pnt from = builder.point(v[k]);
    const gp_Dir along(gp_Vec(from, builder.point(v[(k + 1) % 4])));
    builder.face(new Geom_Plane(gp_Ax3(from, along.Crossed(gp::DZ()), along)),
                 {low[k], up[(k + 1) % 4], high[k], up[k]}, "wall");
  }
  const Handle(Geom_Surface) top = cw_bspline_surface(4, 4, [](double s, double t) { return gp_Pnt(2 * s, 2 * t, 2); });
  if (given)
    builder.face(top, {{high[0], 0, 0, 1, 0}, {high[1], 1, 0, 1, 1}, {high[2], 1, 1, 0, 1}, {high[3], 0, 1, 0, 0}},
                 "top", CW_PATCH_SYMMETRY);
  else
    builder.face(top, {high[0], high[1], high[2], high[3]}, "top");
  return builder.build("cube", gp_Trsf(), false);
}

static std::string failure_of(const std::function<void()> &run) {
  try {
    run();
  } catch (const std::exception &failure) {
    return failure.what();
  }
  return "";
}

static void free_surfaces_have_given_borders(void **) {
  CwSolid *solid = cube_with_free_top(true);
  assert_string_equal(cw_solid_fault(*solid).c_str(), "");
  assert_near(hand_volume(solid->solid), 8, 1e-9);
  assert_int_equal(named(*solid, "top").kind, CW_PATCH_SYMMETRY);
  cw_solid_free(&solid);
  assert_string_equal(failure_of([] { cube_with_free_top(false); }).c_str(),
                      "an edge without a border on a free surface");
}

// Four vertices, the six lines between them, and what closes three rounds of four of them is a projective plane: each
// line lies on two faces, and still there is no outside.
static void what_does_not_close_is_told(void **) {
  const auto plane = [] { return new Geom_Plane(gp_Ax3(gp::XOY())); };
  LoopBuilder one_sided(PLANE_CURVE, 1);
  int v[4], e[4][4];
  for (int k = 0; k < 4; k++) v[k] = one_sided.vertex(gp_Pnt(k == 1, k == 2, k == 3));
  for (int a = 0; a < 4; a++)
    for (int b = a + 1; b < 4; b++) e[a][b] = e[b][a] = one_sided.line(v[a], v[b]);
  for (const auto &round : {std::array<int, 4>{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 1, 3}}) {
    std::vector<LoopEdge> loop;
    for (int k = 0; k < 4; k++) loop.push_back(e[round[k]][round[(k + 1) % 4]]);
    one_sided.face(plane(), loop, "side");
  }
  assert_string_equal(failure_of([&] { one_sided.build("none", gp_Trsf(), true); }).c_str(),
                      "the faces cannot be oriented");

  LoopBuilder open(PLANE_CURVE, 1);
  for (int k = 0; k < 4; k++) v[k] = open.vertex(gp_Pnt(k == 1 || k == 2, k > 1, 0));
  for (int k = 0; k < 4; k++) e[0][k] = open.line(v[k], v[(k + 1) % 4]);
  assert_string_equal(failure_of([&] {
                        open.face(plane(), {e[0][0], e[0][1], e[0][3]}, "end");
                      }).c_str(),
                      "a loop of patch end is open at its edge 2");
  open.face(plane(), {e[0][0], e[0][1], e[0][2], e[0][3]}, "end");
  assert_string_equal(failure_of([&] { open.build("none", gp_Trsf(), true); }).c_str(),
                      "edge 0 does not lie between two faces");

  LoopBuilder seam(PLANE_CURVE, 1); // a whole cylinder, whose line has it on both sides
  const int low = seam.vertex(gp_Pnt(5, 0, 0)), high = seam.vertex(gp_Pnt(5, 0, 7));
  const int line = seam.line(low, high), below = seam.arc(low, low, 2 * M_PI), above = seam.arc(high, high, 2 * M_PI);
  seam.face(new Geom_CylindricalSurface(gp_Ax3(gp::XOY()), 5), {below, line, above, line}, "wall");
  assert_string_equal(failure_of([&] { seam.build("none", gp_Trsf(), true); }).c_str(),
                      "edge 0 does not lie between two faces");

  LoopBuilder two(PLANE_CURVE, 1);
  hand_tube_faces(two, {0, 5, 7, 2});
  hand_tube_faces(two, {0, 5, 7, 2});
  assert_string_equal(failure_of([&] { two.build("none", gp_Trsf(), false); }).c_str(),
                      "the faces do not hang together");
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rods_and_tubes),
      cmocka_unit_test(faces_are_named_by_their_patch),
      cmocka_unit_test(the_first_face_says_what_is_outside),
      cmocka_unit_test(a_motion_moves_all),
      cmocka_unit_test(cones),
      cmocka_unit_test(free_surfaces_have_given_borders),
      cmocka_unit_test(what_does_not_close_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
