// SPDX-License-Identifier: AGPL-3.0-or-later
// Planes beside an edge in which one face passes smoothly into another.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GC_MakeArcOfCircle.hxx>

extern "C" {
#include "mesher/plan/plan_profile.h"
}

#include "planned_solid.h"

// Half a ring from 5 to 20 mm radius; its outer face is upright up to z = 10 mm, then bends inward with 10 mm radius.
static TopoDS_Shape half_ring() {
  const gp_Pnt at[] = {{5, 0, 0}, {20, 0, 0}, {20, 0, 10}, {10, 0, 20}, {5, 0, 20}};
  const gp_Pnt on_bend(10 + 10 * std::sqrt(0.5), 0, 10 + 10 * std::sqrt(0.5));
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(at[0], at[1]));
  wire.Add(BRepBuilderAPI_MakeEdge(at[1], at[2]));
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(at[2], on_bend, at[3]).Value()));
  wire.Add(BRepBuilderAPI_MakeEdge(at[3], at[4]));
  wire.Add(BRepBuilderAPI_MakeEdge(at[4], at[0]));
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp::OZ(), M_PI).Shape();
}

struct Ring : PlannedSolid {
  Ring() : PlannedSolid(half_ring()) {}
  double touch(const CwPlane &plane, const CwPlane *end = nullptr) const {
    return cw_plan_touch(&model, &whole, &plane, end);
  }
};

// Lengths from the circle z = 10 mm of 20 mm radius.
static void planes_beside_a_smooth_edge_touch_it(void **) {
  Ring ring;
  const double x[] = {0, 0.02, 0.01}, h = cw_size_at(ring.size, x);
  CwPlane across = {{0, 0, 1}, 0.01 + 0.1 * h};
  assert_near(ring.touch(across), 0.8, 0.04); // h is not the same all along
  across.offset = 0.01 - 0.375 * h;
  assert_near(ring.touch(across), 0.25, 0.1);
  across.offset = 0.01;
  assert_near(ring.touch(across), 1, 1e-6);
  across.offset = 0.01 + 0.7 * h;
  assert_near(ring.touch(across), 0, 1e-9);
}

// A plane parallel to the axis touches the circle in one place; half-planes that end before that place do not.
static void planes_that_pass_an_edge_closely_touch_it(void **) {
  Ring ring;
  const CwPlane end = {{1, 0, 0}, 0.012};
  assert_true(ring.touch({{0, 1, 0}, 0.02 - 2e-5}) > 0.9);
  assert_true(ring.touch({{0, 1, 0}, 0.02 + 2e-5}) > 0.9);
  const CwPlane passing = {{0, 1, 0}, 0.02 - 2e-5};
  assert_near(ring.touch(passing, &end), 0, 1e-9);
}

static void planes_that_cross_edges_do_not_touch_them(void **) {
  Ring ring;
  assert_near(ring.touch({{1, 0, 0}, 0.001}), 0, 1e-9);
  assert_near(ring.touch({{0, 1, 0}, 0.012}), 0, 1e-9);
}

// Many planes across one direction at once, each as if it were alone.
static void planes_of_one_direction_are_told_together(void **) {
  enum { COUNT = 301 };
  Ring ring;
  const double direction[] = {0, 0, 1}, low = -0.001, step = 22e-3 / (COUNT - 1);
  double touch[COUNT], most = 0;
  cw_plan_touches(&ring.model, &ring.whole, direction, low, step, COUNT, touch);
  for (int i = 0; i < COUNT; i++) {
    assert_near(touch[i], ring.touch({{0, 0, 1}, low + step * i}), 1e-9);
    most = std::fmax(most, touch[i]);
  }
  assert_in_range((int)(100 * most), 90, 100); // half a step beside the edge, or less
}

// A border of a left-out face along x, 2 mm long, and chords beside it that stand for it or not.
static void cuts_at_a_left_out_face_need_a_corner(void **) {
  CwPlanEdgePoint point = {};
  point.tangent[0] = 1;
  point.half = 1e-3;
  CwPlanStand stand[2] = {{{{-2e-3, 1e-4, 0}, {0.2e-3, 1e-4, 0}}, 1e-4}, {{{0.2e-3, 0.1, 0}, {2e-3, 0.1, 0}}, 1e-4}};
  CwPlanModel model = {};
  model.edge_count = 1;
  model.edge = &point;
  model.stand = stand;
  int32_t only = 0;
  CwPlanPart part = {};
  part.edge_count = 1;
  part.edge = &only;
  const double across[] = {1, 0, 0};
  for (int stands = 0; stands <= 2; stands++) {
    point.stand_count = stands;
    // Where the plane crosses the border: beside it the first chord, beyond that none, and the second far away.
    const double place[] = {-1.5e-3, -0.5e-3, 0.5e-3, 1.5e-3};
    for (int i = 0; i < 4; i++) {
      const int crosses = i == 1 || i == 2, corner = i == 1 && stands > 0;
      const CwPlane plane = {{1, 0, 0}, place[i]};
      double touch;
      cw_plan_touches(&model, &part, across, place[i], 1, 1, &touch);
      assert_int_equal(cw_plan_touch(&model, &part, &plane, nullptr) > 1, crosses && !corner);
      assert_int_equal(touch > 1, crosses && !corner);
    }
  }
  const CwPlane along = {{0, 1, 0}, 1e-5};
  assert_near(cw_plan_touch(&model, &part, &along, nullptr), 0, 0);
}

// Both sides of a plane know the edge beside it.
static void parts_keep_the_edges_beside_them(void **) {
  Ring ring;
  const double x[] = {0, 0.02, 0.01}, h = cw_size_at(ring.size, x);
  const CwPlane above = {{0, 0, 1}, 0.01 - 0.1 * h}, below = {{0, 0, 1}, 0.01 - 0.2 * h};
  CwPlanPart half;
  check(cw_plan_part_clip(&ring.model, &ring.whole, &above, 0, &half));
  assert_near(cw_plan_touch(&ring.model, &half, &below, nullptr), 0.6, 0.06);
  cw_plan_part_free(&half);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(planes_beside_a_smooth_edge_touch_it),
                              cmocka_unit_test(planes_that_pass_an_edge_closely_touch_it),
                              cmocka_unit_test(planes_that_cross_edges_do_not_touch_them),
                              cmocka_unit_test(planes_of_one_direction_are_told_together),
                              cmocka_unit_test(cuts_at_a_left_out_face_need_a_corner),
                              cmocka_unit_test(parts_keep_the_edges_beside_them)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
