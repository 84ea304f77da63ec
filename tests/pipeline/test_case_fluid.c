// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "given_case.h"
#include "pipeline/water.h"
#include "tests/unit_test.h"

static CwStatus read_with(const char *fluid, CwCase *table) {
  return read_given("name: f\noperating_point:\n  flow_rate_m3_per_h: 25\n  head_m: 10\n  speed_rpm: 1450\nfluid:\n",
                    fluid, table);
}

static void temperature_sets_water(void **state) {
  CwCase table;
  assert_int_equal(read_with("  temperature_c: 80\n", &table), CW_OK);
  assert_true(table.fluid.density == cw_water_density(80));
  assert_true(table.fluid.kinematic_viscosity == cw_water_kinematic_viscosity(80));
  assert_true(table.fluid.vapour_pressure == cw_water_vapour_pressure(80));
  assert_true(fabs(table.fluid.vapour_pressure - 47.41e3) < 30); // steam tables: 0.4741 bar
}

// Without a temperature water at 20 degrees Celsius; given values go before it where they do not contradict.
static void given_values_stay(void **state) {
  CwCase table;
  assert_int_equal(read_with("  density_kg_per_m3: 800\n", &table), CW_OK);
  assert_true(table.fluid.density == 800);
  assert_true(table.fluid.vapour_pressure == cw_water_vapour_pressure(20));
  assert_int_equal(read_with("  temperature_c: 20\n  density_kg_per_m3: 1000\n  vapour_pressure_pa: 0\n", &table),
                   CW_OK);
  assert_true(table.fluid.density == 1000 && table.fluid.vapour_pressure == 0);
}

static void contradictions_are_told(void **state) {
  CwCase table;
  assert_int_equal(read_with("  temperature_c: 80\n  density_kg_per_m3: 998.2\n", &table), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), ":8:22: fluid.density_kg_per_m3: 998.2 contradicts fluid.temperature_c: "
                                            "water of 80 degrees Celsius has 971.7"));
  assert_int_equal(read_with("  temperature_c: 80\n  kinematic_viscosity_m2_per_s: 1e-6\n", &table), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "fluid.kinematic_viscosity_m2_per_s: 1e-06 contradicts"));
  assert_int_equal(read_with("  temperature_c: 400\n", &table), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "0.01 to 370 degrees Celsius"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(temperature_sets_water),
      cmocka_unit_test(given_values_stay),
      cmocka_unit_test(contradictions_are_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
