// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "pipeline/water.h"
#include "tests/unit_test.h"

static void near_share(double value, double expected, double share) {
  if (!(fabs(value / expected - 1) <= share)) fail_msg("%.10g is not %.10g", value, expected);
}

// The values for checking that SR1-86 prints: 273.16, 373.1243 and 647.096 K.
static void saturation_of_the_release(void **state) {
  near_share(cw_water_vapour_pressure(273.16 - 273.15), 611.657, 1e-6);
  near_share(cw_water_vapour_pressure(373.1243 - 273.15), 0.101325e6, 1e-6);
  near_share(cw_water_vapour_pressure(647.096 - 273.15), 22.064e6, 1e-6);
  near_share(cw_water_density(273.16 - 273.15), 999.789, 1e-6);
  near_share(cw_water_density(373.1243 - 273.15), 958.365, 1e-6);
  near_share(cw_water_density(647.096 - 273.15), 322, 1e-6);
}

// Table 4 of R12-08: temperature in K, density in kg/m3, viscosity in uPa s.
static void viscosity_of_the_release(void **state) {
  static const double rows[][3] = {{298.15, 998, 889.735100}, {298.15, 1200, 1437.649467}, {373.15, 1000, 307.883622},
                                   {433.15, 1, 14.538324},    {433.15, 1000, 217.685358},  {873.15, 600, 77.430195},
                                   {1173.15, 400, 64.154608}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    near_share(cw_water_viscosity(rows[i][0] - 273.15, rows[i][1]), 1e-6 * rows[i][2], 5e-8);
}

// At 20 degrees Celsius: 998.2 kg/m3 and 1.0016 mPa s (IAPWS at 0.1 MPa), 2339 Pa.
static void water_at_room_temperature(void **state) {
  near_share(cw_water_density(20), 998.2, 1e-4);
  near_share(cw_water_kinematic_viscosity(20), 1.0016e-3 / 998.2, 2e-3);
  near_share(cw_water_vapour_pressure(20), 2339, 2e-4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(saturation_of_the_release),
      cmocka_unit_test(viscosity_of_the_release),
      cmocka_unit_test(water_at_room_temperature),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
