// SPDX-License-Identifier: AGPL-3.0-or-later
// Planes beside an edge in which one face passes smoothly into another, and across sharp ones.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <gp_Ax1.hxx>

extern "C" {
#include "mesher/common/vec.h"
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
  assert_near(ring.touch(across), 1, 1e-6);
  across.offset = 0.01 - 0.375 * h;
  assert_near(ring.touch(across), 0.5, 0.1); // h is not the same all along
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

// Both sides of a plane know the edge beside it.
static void parts_keep_the_edges_beside_them(void **) {
  Ring ring;
  const double x[] = {0, 0.02, 0.01}, h = cw_size_at(ring.size, x);
  const CwPlane above = {{0, 0, 1}, 0.01 - 0.1 * h}, below = {{0, 0, 1}, 0.01 - 0.2 * h};
  CwPlanPart half;
  Ring::check(cw_plan_part_clip(&ring.model, &ring.whole, &above, 0, &half));
  assert_near(cw_plan_touch(&ring.model, &half, &below, nullptr), 1, 1e-6);
  cw_plan_part_free(&half);
}

// Cosine of the best of many columns in the plane with normal n to both a and b.
static double best_column(const double a[3], const double b[3], const double n[3]) {
  double u[3], v[3], best = -1;
  const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
  cw_cross(n, std::fabs(n[0]) < 0.7 ? x : y, u);
  cw_unit(u);
  cw_cross(n, u, v);
  for (int i = 0; i < 20000; i++) {
    double c = std::cos(i * M_PI / 10000), s = std::sin(i * M_PI / 10000);
    best = std::fmax(best, std::fmin(c * cw_dot(a, u) + s * cw_dot(a, v), c * cw_dot(b, u) + s * cw_dot(b, v)));
  }
  return best;
}

// Wedges of 150, 90 and 40 degrees, bent and hollow ones alike, and planes from all sides.
static void columns_in_planes_stand_as_well_as_the_best_one(void **) {
  for (double wedge : {150.0, 90.0, 40.0}) {
    double turn = M_PI - wedge * M_PI / 180;
    double normal[1][2][3] = {{{1, 0, 0}, {std::cos(turn), std::sin(turn), 0}}};
    CwPlanModel model = {};
    model.edge_normal = normal;
    for (int i = 0; i < 200; i++) {
      double z = std::cos(0.5 + 2 * i * M_PI / 400), r = std::sqrt(1 - z * z), angle = 2.4 * i;
      const double n[3] = {r * std::cos(angle), r * std::sin(angle), z};
      assert_near(cw_plan_edge_cosine(&model, 0, n), best_column(normal[0][0], normal[0][1], n), 1e-3);
    }
  }
}

// The edge along z at x = 20 mm, y = 0, z = 0 .. 10 mm, of 90 degrees, and a plane that cuts it so.
static void planes_know_how_columns_lean_on_an_edge_they_cross(void **) {
  Ring ring;
  for (double tilt : {0.0, 1.2}) {
    const double s = std::sin(tilt) * std::sqrt(0.5);
    CwPlane plane = {{s, -s, std::cos(tilt)}, 0};
    const double x[] = {0.02, 0, 0.004};
    plane.offset = cw_dot(plane.normal, x);
    const CwPlane here = {{0, 1, 0}, -0.001}, elsewhere = {{0, 1, 0}, 0.001};
    const CwPlane bound = {{1, 0, 0}, 0.019};
    assert_near(cw_plan_place(&ring.model, &ring.whole, &plane, &bound).lean, std::cos(tilt) * std::sqrt(0.5), 1e-6);
    assert_true(cw_plan_place(&ring.model, &ring.whole, &plane, &here).lean < 0.71);
    assert_near(cw_plan_place(&ring.model, &ring.whole, &plane, &elsewhere).lean, 1, 1e-9);
    CwPlanProfile profile;
    cw_plan_profile(&ring.model, &ring.whole, plane.normal, 1000, &profile);
    assert_true(cw_profile_at(&profile, cw_profile_bin(&profile, plane.offset)).lean <
                std::cos(tilt) * std::sqrt(0.5) + 1e-6);
  }
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(planes_beside_a_smooth_edge_touch_it),
                              cmocka_unit_test(planes_that_pass_an_edge_closely_touch_it),
                              cmocka_unit_test(planes_that_cross_edges_do_not_touch_them),
                              cmocka_unit_test(parts_keep_the_edges_beside_them),
                              cmocka_unit_test(columns_in_planes_stand_as_well_as_the_best_one),
                              cmocka_unit_test(planes_know_how_columns_lean_on_an_edge_they_cross)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
