// SPDX-License-Identifier: AGPL-3.0-or-later
// Planes that touch a face or an edge where they ought to cross it: they are refused, so that others may be tried.
#include <cstring>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <Bnd_Box.hxx>
#include <TopoDS.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/network/network.h"
}

#include "solids.h"

// A solid, else half a cylinder of 20 mm radius and 30 mm length over the plane y = 0, and up to two partition planes.
struct Half {
  CwCad *cad;
  CwBackground background;
  CwVerticals *inside = nullptr;
  double none[3] = {};
  CwNetwork network = {};
  CwOutcome outcome;

  explicit Half(const TopoDS_Shape &shape = BRepPrimAPI_MakeCylinder(20, 30, M_PI).Shape(),
                const PatchOfFace &patch_of = all_wall)
      : cad(open_solid(shape, patch_of)) {
    assert_int_equal(cw_background_make(cad, 1e-4, 0.2, &background), CW_OK);
    assert_int_equal(cw_verticals_make(background.x, background.triangle_count, background.triangle, &inside), CW_OK);
  }
  ~Half() {
    cw_network_free(&network);
    cw_verticals_free(&inside);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
  // By a plane, and one half again by another.
  CwOutcomeKind divide(const CwPlane &plane, const CwPlane *other = nullptr) {
    CwPlanNode node[2] = {{plane, -1, {other ? 1 : -1, -2}, 0}, {other ? *other : plane, 0, {-1, -3}, 0}};
    CwPlan plan = {other ? 2 : 1, other ? 3 : 2, node, none, 0, 0, 0, 0};
    cw_network_free(&network);
    outcome = {};
    assert_int_equal(cw_network_make(NULL, cad, &background, inside, &plan, &network, &outcome), CW_OK);
    return outcome.kind;
  }
};

// The highest point of the background, on one of the two arcs.
static double highest(const CwBackground &background, double *x) {
  double most = 0;
  for (int i = 0; i < background.point_count; i++) {
    if (background.x[i][1] > most) most = background.x[i][1], *x = background.x[i][0];
  }
  return most;
}

static void a_plane_through_the_middle_divides(void **) {
  Half half;
  assert_int_equal(half.divide({{0, 1, 0}, 0.011}), CW_OUTCOME_DONE);
  assert_int_equal(half.divide({{0, 0, 1}, 0.017}), CW_OUTCOME_DONE);
}

static void a_plane_that_grazes_is_refused(void **) {
  Half half;
  double x = 0, top = highest(half.background, &x);
  // A tenth of a micrometre below a point of the background on the arc, and parallel to the surface there.
  assert_near(std::hypot(x, top), 0.02, 1e-9);
  CwPlane plane = {{x / 0.02, top / 0.02, 0}, 0.02 - 1e-7};
  assert_int_equal(half.divide(plane), CW_OUTCOME_REPLAN);
  assert_non_null(strstr(half.outcome.reason, "partition plane 0 grazes"));
  assert_near(std::hypot(half.outcome.place[0][0], half.outcome.place[0][1]), 0.02, 1e-3);
  char text[CW_OUTCOME_TEXT_SIZE];
  print_message("  %s\n", cw_outcome_text(&half.outcome, 1e3, text));
}

// A plane that touches the upper arc and goes into the half cylinder below it: cells that the arc does not
// reach can be divided by it.
static void a_plane_may_graze_outside_of_its_cell(void **) {
  Half half;
  const double tilt = 0.05;
  double x = 0, top = highest(half.background, &x);
  const CwPlane slanted = {{std::cos(tilt) * x / 0.02, std::cos(tilt) * top / 0.02, -std::sin(tilt)},
                           (0.02 - 1e-7) * std::cos(tilt) - 0.03 * std::sin(tilt)};
  const CwPlane below = {{0, 0, 1}, 0.017}, above = {{0, 0, -1}, -0.017};
  assert_int_equal(half.divide(slanted), CW_OUTCOME_REPLAN);
  assert_int_equal(half.divide(above, &slanted), CW_OUTCOME_REPLAN);
  assert_non_null(strstr(half.outcome.reason, "partition plane 1 grazes"));
  assert_int_equal(half.divide(below, &slanted), CW_OUTCOME_DONE);
}

// The second holds the very corner in which the first crosses the edge where the half cylinder's flat side begins; a
// millimetre beside it they meet on faces, not on a border.
static void planes_that_meet_on_an_edge_are_refused(void **) {
  Half half;
  const CwPlane level = {{0, 0, 1}, 0.017};
  CwPlane slanted = {{-0.48, 0.64, 0.6}, 0};
  assert_int_equal(half.divide(level), CW_OUTCOME_DONE);
  const CwCorner *corner = nullptr;
  for (int i = 0; i < half.network.corner_count; i++) {
    const CwCorner &one = half.network.corner[i];
    if (one.edge >= 0 && one.x[0] > 0.019 && std::fabs(one.x[1]) < 1e-9) corner = &one;
  }
  assert_non_null(corner);
  const double x[3] = {corner->x[0], corner->x[1], corner->x[2]};
  slanted.offset = cw_plane_distance(&slanted, x);
  assert_int_equal(half.divide(level, &slanted), CW_OUTCOME_REPLAN);
  assert_non_null(strstr(half.outcome.reason, "partition planes 0 and 1 meet on the border of face"));
  for (int k = 0; k < 3; k++) assert_near(half.outcome.place[0][k], x[k], 1e-8);
  slanted.offset += 1e-3;
  assert_int_equal(half.divide(level, &slanted), CW_OUTCOME_DONE);
}

// A pyramid of 20 mm over a square of as much.
static TopoDS_Shape pyramid() {
  const gp_Pnt top(10, 10, 20), base[4] = {{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}};
  BRepBuilderAPI_Sewing sewing;
  BRepBuilderAPI_MakePolygon square(base[0], base[1], base[2], base[3], true);
  sewing.Add(BRepBuilderAPI_MakeFace(square.Wire()).Face());
  for (int i = 0; i < 4; i++)
    sewing.Add(
        BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakePolygon(base[i], base[(i + 1) % 4], top, true).Wire()).Face());
  sewing.Perform();
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape())).Solid();
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

// At the top of the pyramid, on which a wall ends, edges between three open sides meet: two of them. Of two open sides
// one edge does.
static void open_patches_that_meet_on_the_wall_are_refused(void **) {
  for (int open = 1; open < 4; open++) {
    int sides = 0;
    Half half(pyramid(), [&](const TopoDS_Face &face) {
      Bnd_Box box;
      BRepBndLib::Add(face, box);
      const bool is_side = box.CornerMax().Z() > 10;
      return std::string(is_side && sides++ < open ? "side,inlet" : "wall,wall");
    });
    const int refused = open == 3 ? CW_OUTCOME_REPLAN : CW_OUTCOME_DONE;
    assert_int_equal(half.divide({{0, 0, 1}, 0.007}), refused);
    if (open < 3) continue;
    assert_non_null(strstr(half.outcome.reason,
                           "3 partition planes or open patches, more than two, meet in one point of the wall"));
    const double top[3] = {0.01, 0.01, 0.02};
    for (int k = 0; k < 3; k++) assert_near(half.outcome.place[0][k], top[k], 1e-8);
  }
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(a_plane_through_the_middle_divides),
                              cmocka_unit_test(a_plane_that_grazes_is_refused),
                              cmocka_unit_test(a_plane_may_graze_outside_of_its_cell),
                              cmocka_unit_test(planes_that_meet_on_an_edge_are_refused),
                              cmocka_unit_test(open_patches_that_meet_on_the_wall_are_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
