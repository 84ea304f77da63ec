// SPDX-License-Identifier: AGPL-3.0-or-later

#include <math.h>

#include "mesher/common/model_unit.h"
#include "tests/unit_test.h"

static void a_model_is_a_quarter_to_a_half_of_its_unit(void **state) {
  for (int power = -20; power <= 20; power++) {
    assert_int_equal(cw_model_unit_power(ldexp(0.25, power)), power);
    assert_int_equal(cw_model_unit_power(ldexp(0.3, power)), power);
    assert_int_equal(cw_model_unit_power(nextafter(ldexp(0.5, power), 0)), power);
    assert_int_equal(cw_model_unit_power(ldexp(0.5, power)), power + 1);
  }
}

static void messages_are_in_millimetres(void **state) {
  assert_true(cw_model_unit() == 1);
  assert_true(cw_mm(0.25) == 250);
  cw_model_unit_set(-3);
  assert_true(cw_model_unit() == 0.125);
  assert_true(cw_mm(0.25) == 31.25);
  assert_true(cw_mm3(1) == 125.0 * 125 * 125);
  cw_model_unit_set(0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_model_is_a_quarter_to_a_half_of_its_unit),
      cmocka_unit_test(messages_are_in_millimetres),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
