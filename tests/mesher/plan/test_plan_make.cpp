// SPDX-License-Identifier: AGPL-3.0-or-later
// A bar planned as a whole, against the same done step by step.
#include <cmath>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/plan/plan_audit.h"
#include "mesher/plan/plan_divide.h"
#include "mesher/plan/plan_make.h"
}

#include "planned_solid.h"

static const double layers = 1e-3;

// 60 x 20 x 20 mm with layers of 1 mm, its plan, and what it was planned on.
struct Bar : PlannedSolid {
  CwPlanOptions options = {};
  CwPlan plan = {};
  CwPlanModel seen = {};
  CwPlanPart all = {};

  explicit Bar(int32_t regions) : PlannedSolid(BRepPrimAPI_MakeBox(60, 20, 20).Shape(), layers) {
    options.region_count = regions;
    options.thickness = thickness_of;
    options.given = &layers;
    options.base_size = 2e-3;
    options.prism_factor = 12;
    check(cw_plan_make(nullptr, cad, &background, inside, size, &options, &plan));
    check(cw_plan_audit(&plan));
    check(cw_plan_model_make(nullptr, cad, &background, inside, size, &options, &seen));
    check(cw_plan_part_whole(&seen, &all));
  }
  ~Bar() {
    cw_plan_part_free(&all);
    cw_plan_model_free(&seen);
    cw_plan_free(&plan);
  }
  // The work in the cell of a node or region (its number below 0), cut out plane by plane.
  void check_work(const CwPlanPart &part, int32_t node) const {
    if (node < 0) {
      assert_near(plan.predicted_cells[-1 - node], part.work, 1e-9 * all.work);
      return;
    }
    for (int side = 0; side < 2; side++) {
      CwPlanPart half;
      check(cw_plan_part_clip(&seen, &part, &plan.node[node].plane, side, &half));
      check_work(half, plan.node[node].child[side]);
      cw_plan_part_free(&half);
    }
  }
};

// Planes across it leave as much work to each region, to 15 %, and each has the cells that lie in it.
static void a_bar_is_planned(void **) {
  for (int32_t regions : {2, 3, 4}) {
    const Bar bar(regions);
    assert_int_equal(bar.plan.region_count, regions);
    assert_int_equal(bar.plan.node_count, regions - 1);
    assert_int_equal(bar.plan.sector_count, 0);
    for (int32_t n = 0; n < bar.plan.node_count; n++) assert_true(std::fabs(bar.plan.node[n].plane.normal[0]) > 0.95);
    for (int32_t r = 0; r < regions; r++) assert_near(bar.plan.predicted_cells[r] / (bar.all.work / regions), 1, 0.15);
    bar.check_work(bar.all, 0);
  }
}

// To the last bit what its steps make, with the mean work of as many regions as are asked.
static void it_is_the_sum_of_its_steps(void **) {
  for (int32_t regions : {2, 7}) {
    Bar bar(regions);
    CwPlan steps;
    check(cw_plan_new((size_t)regions, &steps));
    bar.seen.mean_work = bar.all.work / regions;
    check(cw_plan_divide(&bar.seen, &steps, &bar.all, regions, -1, 0));
    assert_int_equal(bar.plan.region_count, steps.region_count);
    assert_int_equal(bar.plan.node_count, steps.node_count);
    for (int32_t n = 0; n < steps.node_count; n++) {
      assert_memory_equal(&bar.plan.node[n].plane, &steps.node[n].plane, sizeof steps.node[n].plane);
      assert_memory_equal(bar.plan.node[n].child, steps.node[n].child, sizeof steps.node[n].child);
    }
    for (int32_t r = 0; r < steps.region_count; r++)
      assert_near(bar.plan.predicted_cells[r], steps.predicted_cells[r], 0);
    cw_plan_free(&steps);
  }
}

static void one_region_has_all(void **) {
  const Bar bar(1);
  assert_int_equal(bar.plan.region_count, 1);
  assert_int_equal(bar.plan.node_count, 0);
  assert_near(bar.plan.predicted_cells[0], bar.all.work, 1e-9 * bar.all.work);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(a_bar_is_planned), cmocka_unit_test(it_is_the_sum_of_its_steps),
                              cmocka_unit_test(one_region_has_all)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
