// SPDX-License-Identifier: AGPL-3.0-or-later
// A sector decomposition over a tank with n equal sides: where it is, and how it is planned.
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>

#include "planned_solid.h"
#include "tank.h"

// Points by angle and height, against the sectors's own answer.
static void sectors_divide_by_angle(void **) {
  for (int n : {3, 5, 6}) {
    Tank tank(n, 2), divided(n, 2, true);
    const double first = 0.3 * 2 * M_PI / n, width = M_PI / n;
    for (int i = 0; i < 1000; i++) {
      const double angle = first + 2 * M_PI * (i + 0.5) / 1000, r = 0.02 + 1e-5 * i, z = i % 2 ? 0.005 : 0.02;
      const double x[3] = {r * std::cos(angle), r * std::sin(angle), z};
      const int wedge = (int)((angle - first) / width), region = z > 0.008 ? 0 : 1 + wedge;
      assert_int_equal(cw_plan_locate(&tank.plan, x), region);
      for (int other = 0; other < tank.plan.region_count; other++) {
        assert_int_equal(cw_plan_in_region(&tank.plan, other, x, 0), other == region);
      }
      double turned[3];
      cw_symmetry_turn(n, 1, x, turned);
      assert_int_equal(cw_plan_locate(&tank.plan, turned), cw_sector_turned_region(&tank.plan, n, 1, region));
      assert_int_equal(cw_sector_first_region(&tank.plan, n, region), region == 0 ? 0 : 1 + wedge % 2);
      const int beyond = region > 0 && cw_plane_distance(&divided.node[1 + 2 * n + wedge].plane, x) > 0;
      const int half = region == 0 ? 0 : 1 + 2 * wedge + beyond;
      assert_int_equal(cw_plan_locate(&divided.plan, x), half);
      for (int other = 0; other < divided.plan.region_count; other++) {
        assert_int_equal(cw_plan_in_region(&divided.plan, other, x, 0), other == half);
      }
      assert_int_equal(cw_plan_locate(&divided.plan, turned), cw_sector_turned_region(&divided.plan, n, 1, half));
      assert_int_equal(cw_sector_first_region(&divided.plan, n, half), half == 0 ? 0 : 1 + (half - 1) % 4);
    }
  }
}

// Both half-planes beside a wedge bound what lies in it; no plane of another wedge does.
static void wedges_have_two_half_planes(void **) {
  Tank tank(5, 1, true);
  for (int j = 0; j < 5; j++) {
    int bounds = 0, node = 6 + j;
    for (CwPlanBound b = cw_plan_bound(&tank.plan, node); b.node >= 0; b = cw_plan_next_bound(&tank.plan, b)) bounds++;
    assert_int_equal(bounds, 3);
    for (int other = 0; other <= 10; other++) {
      const bool bounding = other == 0 || other == 1 + j || other == 1 + (j + 1) % 5;
      assert_int_equal(cw_plan_is_ancestor(&tank.plan, other, node), bounding);
    }
    assert_int_equal(cw_sector_turned_node(&tank.plan, 5, 1, node), 6 + (j + 1) % 5);
  }
}

// The tank as the planner sees it, divided into so many regions.
struct PlannedTank : PlannedSolid {
  CwPlan plan = {};
  CwStatus status;
  CwOutcome outcome = {};
  PlannedTank(const TopoDS_Shape &shape, int turns, int regions) : PlannedSolid(shape) {
    const double thickness = 1e-3;
    const CwPlanOptions options = {regions, thickness_of, &thickness, 2e-3, 12};
    status = cw_sector_plan_make(NULL, cad, &background, inside, size, &options, turns, &plan, &outcome);
  }
  ~PlannedTank() {
    cw_plan_free(&plan);
  }
};

// Each pitch has the planes of the first one, turned, and its work; all together have that of the whole.
static void pitches_are_planned_alike(void **) {
  const int turns = 5;
  PlannedTank tank(tank_solid(turns), turns, 11);
  check(tank.status);
  assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
  const CwPlan &plan = tank.plan;
  double sum = 0;
  assert_int_equal(plan.sector_turns, turns);
  assert_int_equal(plan.sector_count % turns, 0);
  assert_int_equal((plan.region_count - plan.sector_region) % turns, 0);
  assert_true(plan.region_count > turns && plan.region_count <= 16);
  assert_int_equal(plan.node_count, plan.region_count);
  for (int r = 0; r < plan.region_count; r++) {
    sum += plan.predicted_cells[r];
    const int next = cw_sector_turned_region(&plan, turns, 1, r);
    assert_near(plan.predicted_cells[next], plan.predicted_cells[r], 0);
    assert_int_equal(cw_sector_turned_region(&plan, turns, turns, r), r);
  }
  assert_near(sum / tank.whole.work, 1, 0.03); // whose samples are those of three regions
  for (int n = 0; n < plan.node_count; n++) {
    const int next = cw_sector_turned_node(&plan, turns, 1, n);
    double turned[3];
    cw_symmetry_turn(turns, next == n ? 0 : 1, plan.node[n].plane.normal, turned);
    for (int k = 0; k < 3; k++) assert_near(plan.node[next].plane.normal[k], turned[k], 1e-12);
    assert_near(plan.node[next].plane.offset, plan.node[n].plane.offset, 1e-12);
    assert_true(plan.node[n].parent < n);
  }
  // Node 0 stands across the axis with the water's face, at z = 40 mm, on its negative side, above the hub's top.
  assert_near(plan.node[0].plane.normal[2], -1, 1e-12);
  assert_true(plan.node[0].plane.offset > -0.04 && plan.node[0].plane.offset < 0);
  const double water[] = {0.001, 0.002, 0.039};
  assert_true(cw_plan_locate(&plan, water) < plan.sector_region);
}

// Slices before the sectors are about as large as the regions of a pitch: as many as there fit into them, or one more.
// The samples of all pitches together tell work by 2 %.
static void slices_are_as_large_as_regions(void **) {
  const int turns = 5;
  for (int asked : {7, 16}) {
    PlannedTank tank(tank_solid(turns), turns, asked);
    check(tank.status);
    assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
    const int slices = tank.plan.sector_region, regions = (tank.plan.region_count - slices) / turns;
    double pipe = 0, pitch = 0;
    for (int r = 0; r < slices + regions; r++) (r < slices ? pipe : pitch) += tank.plan.predicted_cells[r];
    const double fitting = pipe / pitch * regions;
    assert_true(slices > 0.98 * fitting - 1 && slices <= 1.02 * fitting + 1 && slices <= asked);
  }
}

// Where fluid lies on the axis from end to end no sector decomposition can be.
static void fluid_all_along_the_axis_has_no_sectors(void **) {
  PlannedTank cube(BRepPrimAPI_MakeBox(gp_Pnt(-20, -20, 0), 40, 40, 40).Shape(), 4, 9);
  assert_int_equal(cube.status, CW_OK);
  assert_int_equal(cube.outcome.kind, CW_OUTCOME_ASYMMETRIC);
  assert_null(cube.plan.node);
}

// With a shaft from end to end the slices lie where the domain is narrow: below, in a pipe under a wheel.
static void a_shaft_leaves_sectors(void **) {
  const int turns = 4;
  for (int upside_down = 0; upside_down < 2; upside_down++) {
    const double from = upside_down ? 30 : 0, wheel = upside_down ? 0 : 40;
    const TopoDS_Shape pipe = BRepPrimAPI_MakeBox(gp_Pnt(-8, -8, from), 16, 16, 40).Shape();
    const TopoDS_Shape water =
        BRepAlgoAPI_Fuse(pipe, BRepPrimAPI_MakeBox(gp_Pnt(-20, -20, wheel), 40, 40, 30).Shape()).Shape();
    const TopoDS_Shape shaft = BRepPrimAPI_MakeBox(gp_Pnt(-3, -3, -1), 6, 6, 80).Shape();
    PlannedTank tank(BRepAlgoAPI_Cut(water, shaft).Shape(), turns, 9);
    check(tank.status);
    assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
    assert_int_equal(tank.plan.sector_turns, turns);
    assert_near(tank.plan.node[0].plane.normal[2], upside_down ? -1 : 1, 1e-12);
    const double eye[] = {0.005, 0.001, upside_down ? 0.069 : 0.001};
    assert_true(cw_plan_locate(&tank.plan, eye) < tank.plan.sector_region);
    const double rim[] = {0.019, 0.001, upside_down ? 0.001 : 0.069};
    assert_true(cw_plan_locate(&tank.plan, rim) >= tank.plan.sector_region);
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sectors_divide_by_angle),
      cmocka_unit_test(wedges_have_two_half_planes),
      cmocka_unit_test(pitches_are_planned_alike),
      cmocka_unit_test(slices_are_as_large_as_regions),
      cmocka_unit_test(fluid_all_along_the_axis_has_no_sectors),
      cmocka_unit_test(a_shaft_leaves_sectors),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
