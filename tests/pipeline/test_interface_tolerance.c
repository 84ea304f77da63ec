// SPDX-License-Identifier: AGPL-3.0-or-later

#include <math.h>

#include "pipeline/mesh/interface_tolerance.h"
#include "tests/unit_test.h"

static void a_hundredth_of_the_shortest_edge(void **state) {
  const double a[3] = {0, 0, 0}, b[3] = {4, 0, 0}, c[3] = {4, 3, 0}, d[3] = {0, 2, 0}, e[3] = {4, 0, 0.5};
  const double *const triangle[4] = {a, b, c}, *const quad[4] = {a, b, c, d}, *const thin[4] = {a, b, e, d};
  assert_true(fabs(cw_interface_tolerance(3, triangle) - 0.03) < 1e-15);
  assert_true(fabs(cw_interface_tolerance(4, quad) - 0.02) < 1e-15);
  assert_true(fabs(cw_interface_tolerance(4, thin) - 0.005) < 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_hundredth_of_the_shortest_edge)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
