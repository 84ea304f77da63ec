// SPDX-License-Identifier: AGPL-3.0-or-later
// A bar divided by the best planes.
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/plan/plan_divide.h"
}

#include "planned_solid.h"

// A bar with layers of 1 mm, which planes across it divide.
struct Bar : PlannedSolid {
  std::vector<CwPlanNode> node = std::vector<CwPlanNode>(8);
  std::vector<double> cells = std::vector<double>(8);
  CwPlan plan = {0, 0, node.data(), cells.data(), 0, 0, 0, 0};

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
    assert_near(bar.node[n].worst, 1, 1e-3);
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
  const CMUnitTest tests[] = {cmocka_unit_test(a_bar_is_divided_across), cmocka_unit_test(one_region_needs_no_plane)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
