// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/viscous_correction.h"
#include "tests/unit_test.h"

static const double hour = 3600, rpm = M_PI / 30;

// 110 m3/h, 77 m at 2950 rpm with 120 cSt: B = 16.5 10.954 1.3119 / (5.8287 7.3698) = 5.520; lg B = 0.74194,
// 0.74194^3.15 = 0.39053, C_H = exp(-0.064438) = 0.9376; 5.52^0.69 = 3.2507, 5.52^(-0.17781) = 0.7380.
static void worked_by_hand(void **state) {
  const CwViscousCorrection c = cw_viscous_correction(120e-6, 110 / hour, 77, 2950 * rpm);
  assert_near(c.parameter, 5.520, 2e-3);
  assert_near(c.head, 0.9376, 1e-4);
  assert_near(c.efficiency, 0.7380, 2e-4);
}

// Of water and thinner fluids nothing is taken away, also in a pump so small that B of water is 3.5.
static void water_has_no_correction(void **state) {
  const CwViscousCorrection water = cw_viscous_correction(1.004e-6, 0.3 / hour, 1, 2900 * rpm);
  assert_true(water.parameter > 3);
  assert_true(water.head == 1 && water.efficiency == 1);
  const CwViscousCorrection thin = cw_viscous_correction(2e-7, 0.3 / hour, 1, 2900 * rpm);
  assert_true(thin.head == 1 && thin.efficiency == 1);
  assert_near(cw_viscous_correction(1.0041e-6, 0.3 / hour, 1, 2900 * rpm).efficiency, 1, 1e-3);
}

// The more viscous, the less of both; beyond B = 40 the factors stay.
static void factors_fall(void **state) {
  double head = 1, efficiency = 1;
  for (double nu = 1.1e-6; nu < 1e-2; nu *= 1.3) {
    const CwViscousCorrection c = cw_viscous_correction(nu, 25 / hour, 10, 1450 * rpm);
    assert_true(c.head <= head && c.efficiency <= efficiency && c.head > 0.4 && c.efficiency > 0.05);
    head = c.head;
    efficiency = c.efficiency;
  }
  assert_near(head, exp(-0.165 * pow(log10(40), 3.15)), 1e-12);
}

// The pump selected for a viscous duty has that duty when it is corrected.
static void selection_undoes_correction(void **state) {
  for (double nu = 1e-6; nu < 1e-2; nu *= 3) {
    const CwViscousCorrection c = cw_viscous_selection(nu, 25 / hour, 10, 1450 * rpm);
    const CwViscousCorrection back = cw_viscous_correction(nu, 25 / hour / c.head, 10 / c.head, 1450 * rpm);
    assert_near(back.head, c.head, 1e-12);
    assert_near(back.efficiency, c.efficiency, 1e-12);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(worked_by_hand),
      cmocka_unit_test(water_has_no_correction),
      cmocka_unit_test(factors_fall),
      cmocka_unit_test(selection_undoes_correction),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
