// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/common/mix.h"
#include "mesher/common/radix.h"
#include "tests/unit_test.h"

enum { COUNT = 5000 };

static void assert_sorted(const CwRadix *record, int count) {
  for (int k = 1; k < count; k++) {
    assert_true(record[k - 1].key <= record[k].key);
    if (record[k - 1].key == record[k].key) assert_true(record[k - 1].item < record[k].item);
  }
}

// Keys of all lengths, and few of them, so that many are equal.
static void sorts_and_is_stable(void **unused) {
  static const uint64_t masks[] = {~0ull, 0xff, 0x7ff0000000000000, 0x8000000000000001, 0x3f800, 0};
  CwRadix record[COUNT];
  uint64_t sum = 0;
  for (size_t m = 0; m < sizeof masks / sizeof *masks; m++) {
    for (int k = 0; k < COUNT; k++) record[k] = (CwRadix){cw_mix((uint64_t)k) & masks[m], k, 0};
    assert_int_equal(cw_radix_sort(COUNT, record), CW_OK);
    assert_sorted(record, COUNT);
    for (int k = 0; k < COUNT; k++) {
      assert_true(record[k].key == (cw_mix((uint64_t)record[k].item) & masks[m]));
      sum += (uint64_t)record[k].item;
    }
  }
  assert_true(sum == 6ull * COUNT * (COUNT - 1) / 2);
  assert_int_equal(cw_radix_sort(0, record), CW_OK);
}

static void keys_ascend_as_numbers(void **unused) {
  const double number[] = {-INFINITY, -1e300, -2.0, -1.5, -5e-324, -0.0, 0.0, 5e-324, 1e-9, 1.0, 1.5, 1e300, INFINITY};
  for (size_t k = 1; k < sizeof number / sizeof *number; k++)
    assert_true(cw_radix_key(number[k - 1]) < cw_radix_key(number[k]));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sorts_and_is_stable),
      cmocka_unit_test(keys_ascend_as_numbers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
