// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/solid.h"

#include <math.h>

#include "tests/unit_test.h"

static void wheels_have_one_size(void **state) {
  assert_true(cw_solid_unit_of_pump(0.2) == 1e-3);
  for (double d2 = 0.01; d2 < 10; d2 *= 1.01) {
    assert_true(fabs(d2 / cw_solid_unit_of_pump(d2) - 200) < 1e-13 * 200);
    assert_true(cw_solid_unit_of_pump(4 * d2) == 4 * cw_solid_unit_of_pump(d2));
  }
}

// D2 is 128 to 256 units, whatever its size, and the unit is a power of two of a millimetre.
static void drawn_wheels_keep_their_bits(void **state) {
  assert_true(cw_solid_unit_of_drawing(0.2) == 1e-3);
  assert_true(cw_solid_unit_of_drawing(0.015) == 1e-3 / 16);
  assert_true(cw_solid_unit_of_drawing(5) == 1e-3 * 32);
  for (double d2 = 0.01; d2 < 10; d2 *= 1.01) {
    int exponent;
    const double unit = cw_solid_unit_of_drawing(d2), units = d2 / unit;
    assert_true(units > 128 * (1 - 1e-15) && units < 256 * (1 + 1e-15));
    assert_true(frexp(unit / 1e-3, &exponent) == 0.5);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(wheels_have_one_size),
      cmocka_unit_test(drawn_wheels_keep_their_bits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
