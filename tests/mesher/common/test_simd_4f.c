// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>

#include "mesher/common/simd_4f.h"
#include "tests/unit_test.h"

static void rows_become_columns(void **state) {
  Cw4f v[4];
  for (int k = 0; k < 16; k++) v[k / 4][k % 4] = (float)k;
  cw_4f_transpose(v);
  for (int k = 0; k < 16; k++) assert_true(v[k % 4][k / 4] == (float)k);
}

static void what_is_masked_is_left_out(void **state) {
  const Cw4f a = {1.0f, 4.0f, -2.0f, 9.0f}, b = {2.0f, 3.0f, -3.0f, 9.0f};
  Cw4f kept = cw_4f_if(a < b, a);
  for (int k = 0; k < 4; k++) assert_true(kept[k] == (a[k] < b[k] ? a[k] : 0.0f));
}

// The difference is taken first: what is left of two places far from the origin is not rounded with them.
static void a_way_is_rounded_once(void **state) {
  const double from[3] = {1e6, -1e6, 1e6 + 1e-4}, to[3] = {1e6 + 1e-3, -1e6 + 2e-3, 1e6};
  Cw4f way = cw_4f_difference(from, to);
  for (int i = 0; i < 3; i++) assert_true(way[i] == (float)(to[i] - from[i]));
  assert_true(way[3] == 0.0f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_become_columns),
      cmocka_unit_test(what_is_masked_is_left_out),
      cmocka_unit_test(a_way_is_rounded_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
