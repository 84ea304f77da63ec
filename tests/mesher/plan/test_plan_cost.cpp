// SPDX-License-Identifier: AGPL-3.0-or-later
// Planes weighed against one another.
extern "C" {
#include "mesher/plan/plan_cost.h"
#include "mesher/plan/plan_lines.h"
}

#include "solids.h"

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

// The slice before the impeller may be as small as it likes: then its plane can stand before the blades. 0.33 of
// 6 x 0.1 past the wanted work; past 0.14 so much more, and at most 3.
static void only_large_slices_cost(void **) {
  for (double work : {1e-3, 0.5, 0.9, 1.0}) assert_near(cw_plan_slice_cost(2 * work, 2), 0, 0);
  assert_near(cw_plan_slice_cost(2.2, 2), 0.33 * 6 * 0.1, 1e-9);
  assert_near(cw_plan_slice_cost(1.15, 1), 0.33 * cw_plan_unevenness(1.15, 1, 1) + 1, 1e-9);
  assert_near(cw_plan_slice_cost(1.5, 1), 0.33 * cw_plan_unevenness(1.5, 1, 1) + 3, 1e-9);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walls_cut_sharply_and_edges_cost),
      cmocka_unit_test(uneven_work_costs),
      cmocka_unit_test(only_large_slices_cost),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
