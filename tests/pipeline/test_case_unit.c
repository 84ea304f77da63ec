// SPDX-License-Identifier: AGPL-3.0-or-later
// Units of keys by their definitions.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/case_unit.h"
#include "tests/unit_test.h"

static void units_convert(void **state) {
  static const struct {
    const char *suffix;
    double value, si;
  } known[] = {
      {"mm", 74, 0.074},
      {"um", 25, 25e-6},
      {"in", 1, 0.0254},
      {"ft", 1, 0.3048},
      {"mm2", 1e6, 1},
      {"deg", 180, 3.14159265358979323846},
      {"rpm", 60, 6.283185307179586},
      {"m3_per_h", 3600, 1},
      {"l_per_min", 60000, 1},
      {"bar", 1, 1e5},
      {"cst", 1, 1e-6},
      {"g_per_cm3", 1, 1000},
      {"hz", 1, 6.283185307179586},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i) {
    const CwUnit *unit = cw_unit_find(known[i].suffix);
    assert_non_null(unit);
    double si = known[i].value * unit->numerator / unit->denominator;
    assert_true(fabs(si - known[i].si) <= 1e-15 * known[i].si);
  }
  size_t stem;
  assert_string_equal(cw_unit_of_key("kinematic_viscosity_m2_per_s", &stem)->suffix, "m2_per_s");
  assert_int_equal(stem, strlen("kinematic_viscosity"));
  assert_null(cw_unit_of_key("blade_count", &stem));
  assert_int_equal(stem, strlen("blade_count"));
  assert_null(cw_unit_of_key("mm", &stem));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(units_convert)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
