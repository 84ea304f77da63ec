// SPDX-License-Identifier: AGPL-3.0-or-later
// Units of keys by their definitions.
#include <math.h>
#include <string.h>

#include "pipeline/case_unit.h"
#include "tests/unit_test.h"

// One of each unit, in SI units; the factor of psi has 13 digits.
static void units_convert(void **state) {
  static const double inch = 0.0254, foot = 0.3048, pound = 0.45359237;
  const struct {
    const char *quantity;
    struct {
      const char *suffix;
      double si;
    } unit[8];
  } known[] = {
      {"length", {{"mm", 1e-3}, {"m", 1}, {"cm", 1e-2}, {"um", 1e-6}, {"in", inch}, {"inch", inch}, {"ft", foot}}},
      {"area", {{"mm2", 1e-6}, {"cm2", 1e-4}, {"m2", 1}, {"in2", inch * inch}}},
      {"angle", {{"deg", M_PI / 180}, {"rad", 1}}},
      {"speed", {{"rpm", M_PI / 30}, {"rad_per_s", 1}, {"hz", 2 * M_PI}}},
      {"velocity", {{"m_per_s", 1}, {"ft_per_s", foot}}},
      {"flow rate", {{"m3_per_h", 1.0 / 3600}, {"m3_per_s", 1}, {"l_per_s", 1e-3}, {"l_per_min", 1e-3 / 60}}},
      {"flow rate", {{"gpm", 231 * inch * inch * inch / 60}, {"ft3_per_s", foot * foot * foot}}},
      {"pressure", {{"pa", 1}, {"kpa", 1e3}, {"mpa", 1e6}, {"bar", 1e5}, {"atm", 101325}}},
      {"pressure", {{"psi", pound * 9.80665 / (inch * inch)}}},
      {"density", {{"kg_per_m3", 1}, {"g_per_cm3", 1e3}, {"lb_per_ft3", pound / (foot * foot * foot)}}},
      {"viscosity", {{"m2_per_s", 1}, {"mm2_per_s", 1e-6}, {"cst", 1e-6}, {"ft2_per_s", foot * foot}}},
      {"temperature", {{"c", 1}}},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; ++i)
    for (int k = 0; known[i].unit[k].suffix; ++k) {
      const CwUnit *unit = cw_unit_find(known[i].unit[k].suffix);
      assert_non_null(unit);
      assert_string_equal(unit->quantity, known[i].quantity);
      assert_near(unit->numerator / unit->denominator, known[i].unit[k].si, 1e-13 * known[i].unit[k].si);
    }
  const CwUnit *mm = cw_unit_find("mm");
  assert_true(74 * mm->numerator / mm->denominator == 0.074); // the nearest double
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
