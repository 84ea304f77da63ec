// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include "mesher/common/incident.h"
#include "tests/unit_test.h"

static void a_strip_and_a_point_alone(void **state) {
  const int32_t triangle[3][3] = {{0, 1, 2}, {2, 1, 4}, {4, 5, 2}}, start[7] = {0, 1, 3, 6, 6, 8, 9};
  const int32_t around[9] = {0, 0, 1, 0, 1, 2, 1, 2, 2};
  CwIncident made;
  assert_int_equal(cw_incident_make(6, 3, triangle, &made), CW_OK);
  assert_memory_equal(made.start, start, sizeof start);
  assert_memory_equal(made.triangle, around, sizeof around);
  cw_incident_free(&made);
  assert_null(made.start);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_strip_and_a_point_alone)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
