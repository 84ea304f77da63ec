// SPDX-License-Identifier: AGPL-3.0-or-later
// Planes weighed against one another, and a box divided by the best.
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/plan/plan_score.h"
}

#include "planned_solid.h"

static void walls_cut_sharply_and_edges_cost(void **) {
  const CwPlanPlace plain = {1, 0, 0}, sharp = {0.5, 0, 0}, sharper = {0.4, 0, 0}, grazing = {1, 10, 0},
                    in_layers = {1, 0, 1};
  assert_near(cw_plan_place_cost(plain), cw_plan_sharpness(1), 1e-12);
  assert_true(cw_plan_place_cost(sharp) > cw_plan_place_cost(plain));
  assert_true(cw_plan_place_cost(sharper) > cw_plan_place_cost(sharp));
  assert_true(cw_plan_place_cost(grazing) > cw_plan_place_cost(plain) + 1);
  assert_true(cw_plan_place_cost(in_layers) > cw_plan_place_cost(plain) + 3);
  assert_near(cw_plan_touch_cost(0), 0, 1e-12);
  assert_true(cw_plan_touch_cost(1) > cw_plan_touch_cost(0.5));
}

// To either side alike; more for what is to be divided further, and steeply past a tenth and a seventh.
static void uneven_work_costs(void **) {
  assert_near(cw_plan_unevenness(3, 3, 1), 0, 1e-12);
  assert_near(cw_plan_unevenness(1.05, 1, 1), cw_plan_unevenness(0.95, 1, 1), 1e-9);
  assert_near(cw_plan_unevenness(1.05, 1, 1), 6 * 0.05, 1e-9);
  assert_near(cw_plan_unevenness(2.1, 2, 1), 6 * 0.05, 1e-9);
  // 0.1 over the fourth root of 16 is 0.05: a share of 0.03 past it.
  assert_near(cw_plan_unevenness(1.08, 1, 16), 6 * 0.08 + 60 * 0.03, 1e-9);
  assert_near(cw_plan_unevenness(1.2, 1, 1), 6 * 0.2 + 60 * 0.1 + 60 * 0.06, 1e-9);
}

// A bar with layers of 1 mm, which planes across it divide.
struct Bar : PlannedSolid {
  std::vector<CwPlanNode> node = std::vector<CwPlanNode>(8);
  std::vector<double> angle = std::vector<double>(8), cells = std::vector<double>(8);
  CwPlan plan = {0, 0, node.data(), cells.data(), angle.data(), 0, 0, 0, 0};

  Bar() : PlannedSolid(BRepPrimAPI_MakeBox(60, 20, 20).Shape()) {}
  void divide(int32_t regions) {
    model.mean_work = whole.work / regions;
    check(cw_plan_divide(&model, &plan, &whole, regions, -1, 0));
  }
};

static void a_bar_is_divided_across(void **) {
  Bar bar;
  bar.divide(3);
  assert_int_equal(bar.plan.region_count, 3);
  assert_int_equal(bar.plan.node_count, 2);
  double sum = 0;
  for (int32_t n = 0; n < 2; n++) {
    assert_near(std::fabs(bar.node[n].plane.normal[0]), 1, 1e-3);
    assert_near(bar.angle[n], 1, 1e-3);
  }
  for (int32_t r = 0; r < 3; r++) {
    sum += bar.cells[r];
    assert_near(bar.cells[r] / bar.model.mean_work, 1, 0.12);
  }
  assert_near(sum / bar.whole.work, 1, 1e-9);
  assert_int_equal(bar.node[0].parent, -1);
  assert_int_equal(bar.node[1].parent, 0);
}

static void one_region_needs_no_plane(void **) {
  Bar bar;
  bar.divide(1);
  assert_int_equal(bar.plan.region_count, 1);
  assert_int_equal(bar.plan.node_count, 0);
  assert_near(bar.cells[0] / bar.whole.work, 1, 1e-9);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(walls_cut_sharply_and_edges_cost), cmocka_unit_test(uneven_work_costs),
                              cmocka_unit_test(a_bar_is_divided_across), cmocka_unit_test(one_region_needs_no_plane)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
