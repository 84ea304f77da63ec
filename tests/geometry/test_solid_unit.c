// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/solid.h"

#include <math.h>

#include "tests/unit_test.h"

// D2 is 128 to 256 units, whatever its size, and the unit is a power of two of a millimetre.
static void wheels_have_one_size(void **state) {
  assert_true(cw_solid_unit_of_pump(0.2) == 1e-3);
  assert_true(cw_solid_unit_of_pump(0.015) == 1e-3 / 16);
  assert_true(cw_solid_unit_of_pump(5) == 1e-3 * 32);
  for (double d2 = 0.01; d2 < 10; d2 *= 1.01) {
    int exponent;
    const double unit = cw_solid_unit_of_pump(d2), units = d2 / unit;
    assert_true(units > 128 * (1 - 1e-15) && units < 256 * (1 + 1e-15));
    assert_true(frexp(unit / 1e-3, &exponent) == 0.5);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(wheels_have_one_size),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
