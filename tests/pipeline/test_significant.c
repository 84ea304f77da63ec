// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/significant.h"

#include <math.h>

#include "tests/unit_test.h"

static void rounding_is_forgotten(void **state) {
  for (double x = 1e-9; x < 1e9; x *= 1.37) {
    const double short_of = cw_significant(x);
    assert_true(fabs(short_of / x - 1) <= ldexp(1, -34));
    assert_true(cw_significant(short_of) == short_of);
    assert_true(cw_significant(-x) == -short_of);
    for (int power = -30; power <= 30; power++) assert_true(cw_significant(ldexp(x, power)) == ldexp(short_of, power));
  }
  assert_true(cw_multiple(1.3, -1) == 1.5 && cw_multiple(-1.3, 1) == -2 && cw_multiple(1e-16, -34) == 0);
  for (double s = 0.075; s < 30; s *= 1.31) assert_true(cw_significant(74 * s / (200 * s)) == cw_significant(0.37));
}

static void what_is_no_number_stays(void **state) {
  assert_true(cw_significant(0) == 0);
  assert_true(isnan(cw_significant(NAN)) && isnan(cw_multiple(NAN, -34)));
  assert_true(cw_significant(-INFINITY) == -INFINITY);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rounding_is_forgotten),
      cmocka_unit_test(what_is_no_number_stays),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
