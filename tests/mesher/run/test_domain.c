// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/domain.h"

#include "mesher/policy.h"
#include "tests/unit_test.h"

static double regions(int64_t cells) {
  const CwMeshTable mesh = {.cells = cells};
  return cells / cw_domain_region_cells(&mesh);
}

// 270,000 cells each; 140 from 38 to 280 million cells; then of 2 million cells each.
static void regions_of_a_mesh(void **state) {
  assert_near(regions(2700000), 10, 1e-9);
  assert_near(regions(38000000), 140, 1e-9);
  assert_near(regions(100000000), 140, 1e-9);
  assert_near(regions(145000000), 140, 1e-9);
  assert_near(regions(280000000), 140, 1e-9);
  assert_near(regions(300000000), 150, 1e-9);
  assert_near(regions(1000000000), 500, 1e-9);
  assert_near(regions(2000000000), 1000, 1e-9);
}

static void the_case_may_ask_for_others(void **state) {
  const CwMeshTable mesh = {.cells = 1000000000, .cells_per_region = 4000000};
  assert_near(cw_domain_region_cells(&mesh), 4e6, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(regions_of_a_mesh),
      cmocka_unit_test(the_case_may_ask_for_others),
  };
  if (cw_policy_start() != CW_OK) return 1;
  return cmocka_run_group_tests(tests, NULL, NULL);
}
