// SPDX-License-Identifier: AGPL-3.0-or-later

#include <math.h>

#include "mesher/common/model_unit.h"
#include "tests/unit_test.h"

static void a_model_is_a_quarter_to_a_half_of_its_unit(void **state) {
  static const double extents[][2] = {{0.25, 1}, {0.3, 1}, {0.4999, 1}, {0.5, 2}}; // in 2^power, and the unit there
  for (double solid = 1e-4; solid < 1; solid *= 1.7) {
    for (int power = -20; power <= 20; power++) {
      for (size_t i = 0; i < sizeof extents / sizeof *extents; i++) {
        cw_model_unit_fit(solid, ldexp(extents[i][0] * solid, power));
        assert_true(cw_model_unit() == ldexp(extents[i][1] * solid, power));
      }
    }
  }
  cw_model_unit_set(1);
}

static void lengths_lose_their_rounding(void **state) {
  cw_model_unit_set(0.3);
  const double length = cw_in_model_unit(0.1);
  assert_true(fabs(length - 1.0 / 3) < 1e-10);
  assert_true(cw_in_model_unit(nextafter(0.1, 1)) == length);
  cw_model_unit_set(1);
}

static void messages_are_in_millimetres(void **state) {
  assert_true(cw_model_unit() == 1);
  assert_true(cw_mm(0.25) == 250);
  cw_model_unit_set(0.125);
  assert_true(cw_model_unit() == 0.125);
  assert_true(cw_mm(0.25) == 31.25);
  assert_true(cw_mm3(1) == 125.0 * 125 * 125);
  cw_model_unit_set(1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_model_is_a_quarter_to_a_half_of_its_unit),
      cmocka_unit_test(lengths_lose_their_rounding),
      cmocka_unit_test(messages_are_in_millimetres),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
