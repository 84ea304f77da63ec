// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/model_unit.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <unistd.h>

#include <cmocka.h>

#include "pipeline/json_read.h"

// D2 is 128 to 256 units, whatever its size, and the unit is a power of two of a millimetre.
static void wheels_have_one_size(void **state) {
  assert_true(cw_model_unit(0.2) == 1e-3);
  assert_true(cw_model_unit(0.015) == 1e-3 / 16);
  assert_true(cw_model_unit(5) == 1e-3 * 32);
  for (double d2 = 0.01; d2 < 10; d2 *= 1.01) {
    int exponent;
    const double unit = cw_model_unit(d2), units = d2 / unit;
    assert_true(units > 128 * (1 - 1e-15) && units < 256 * (1 + 1e-15));
    assert_true(frexp(unit / 1e-3, &exponent) == 0.5);
  }
}

static void file_holds_every_bit(void **state) {
  for (int k = -6; k <= 6; k++) {
    const double unit = ldexp(1e-3, k);
    double read = 0;
    json_t *root = NULL;
    assert_int_equal(cw_model_unit_write(unit, "model-unit-test.json"), CW_OK);
    assert_int_equal(cw_json_read("model-unit-test.json", &root), CW_OK);
    assert_int_equal(cw_json_positive(root, "model.json", "unit_m", &read), CW_OK);
    assert_true(read == unit);
    json_decref(root);
  }
  unlink("model-unit-test.json");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(wheels_have_one_size),
      cmocka_unit_test(file_holds_every_bit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
