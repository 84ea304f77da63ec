// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/case_values.h"

#include <math.h>
#include <stdlib.h>

#include "tests/draw.h"
#include "tests/unit_test.h"

// At 100 rad/s a turn takes 2 pi / 100 s, and 0.01 rad a ten thousandth of a second.
static void each_value_has_its_unit(void **state) {
  const CwCase table = {.name = "paper",
                        .operating_point = {.speed = 100,
                                            .flow_rate = 0.007,
                                            .head = 12.5,
                                            .inlet_pressure = 101325,
                                            .time_step_angle = 0.01},
                        .fluid = {.density = 800, .kinematic_viscosity = 2e-6}};
  static const struct {
    const char *key;
    double wanted;
  } numbers[] = {{"speed", 100},          {"speed_rpm", 100 * 60 / (2 * M_PI)},
                 {"flow_rate", 0.007},    {"head", 12.5},
                 {"density", 800},        {"inlet_pressure", 101325},
                 {"viscosity", 2e-6},     {"dynamic_viscosity", 1.6e-3},
                 {"time_step", 1e-4},     {"time_step_deg", 360 * 0.01 / (2 * M_PI)},
                 {"total_time", M_PI / 5}};
  CwValues values = {0};
  assert_int_equal(cw_case_values_set(&table, &values), CW_OK);
  assert_string_equal(cw_values_get(&values, "case"), "paper");
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
    const char *text = cw_values_get(&values, numbers[i].key);
    if (!text) fail_msg("no value of %s", numbers[i].key);
    assert_near(atof(text) / numbers[i].wanted, 1, 1e-8);
  }
  cw_values_free(&values);
}

static void smooth_walls_have_no_roughness(void **state) {
  CwWalls walls = {.treatment = CW_WALL_FUNCTION_ROUGH, .roughness = 25e-6};
  assert_near(cw_wall_roughness(&walls), 25e-6, 0);
  walls.treatment = CW_WALL_FUNCTION_SMOOTH;
  assert_near(cw_wall_roughness(&walls), 0, 0);
}

// 5 % of 2 m/s: k = 1.5 * 0.1^2; l = 7 % of 1/7 m = 10 mm: epsilon = 0.09^0.75 * 0.015^1.5 / 0.01.
static void turbulence_follows_the_textbook(void **state) {
  CwTurbulence t = cw_turbulence(2, 1.0 / 7);
  assert_near(t.k, 0.015, 1e-15);
  assert_near(t.epsilon, 0.164316767 * 0.00183711731 / 0.01, 1e-9);
  assert_near(t.omega, t.epsilon / (0.09 * 0.015), 1e-11);
}

// Whatever speed and width: both models have the eddy viscosity of a mixing length, Cmu^(1/4) sqrt(k) l, and the root
// mean square of a component of the fluctuations, sqrt(2 k / 3), is 5 % of the speed.
static void both_models_start_from_one_viscosity(void **state) {
  uint64_t seed = 11;
  for (int i = 0; i < 100; ++i) {
    const double speed = pow(10, 4 * draw(&seed) - 2), width = pow(10, 4 * draw(&seed) - 4);
    const CwTurbulence t = cw_turbulence(speed, width);
    const double viscosity = pow(0.09, 0.25) * sqrt(t.k) * 0.07 * width;
    assert_near(sqrt(2 * t.k / 3) / speed, 0.05, 1e-15);
    assert_near(0.09 * t.k * t.k / t.epsilon / viscosity, 1, 1e-12);
    assert_near(t.k / t.omega / viscosity, 1, 1e-12);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_value_has_its_unit),
      cmocka_unit_test(smooth_walls_have_no_roughness),
      cmocka_unit_test(turbulence_follows_the_textbook),
      cmocka_unit_test(both_models_start_from_one_viscosity),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
