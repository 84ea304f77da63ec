// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "mesher/common/eight.h"

static void rows_of_each_half_become_columns(void **state) {
  CwEight v[4];
  for (int k = 0; k < 16; k++) v[k / 4][k % 4] = (float)k, v[k / 4][4 + k % 4] = (float)(100 + k);
  cw_eight_turn(v);
  for (int k = 0; k < 16; k++) {
    assert_true(v[k % 4][k / 4] == (float)k);
    assert_true(v[k % 4][4 + k / 4] == (float)(100 + k));
  }
}

static void halves_are_side_by_side(void **state) {
  const CwFour low = {1.0f, 2.0f, 3.0f, 4.0f}, high = {5.0f, 6.0f, 7.0f, 8.0f};
  CwEight both = cw_eight_of(low, high);
  CwFour again[2] = {cw_eight_low(both), cw_eight_high(both)};
  for (int k = 0; k < 8; k++) assert_true(both[k] == (float)(k + 1) && again[k / 4][k % 4] == both[k]);
}

static void each_of_eight_has_its_own(void **state) {
  const CwEight a = {1.0f, 4.0f, -2.0f, 9.0f, 0.5f, 0.0f, -7.0f, 3.0f};
  const CwEight b = {2.0f, 3.0f, -3.0f, 9.0f, 0.25f, 1.0f, 7.0f, -3.0f};
  CwEight less = cw_eight_less(a, b), more = cw_eight_more(a, b), root = cw_eight_sqrt(a * a);
  CwEight kept = cw_eight_if(a < b, a);
  for (int k = 0; k < 8; k++) {
    assert_true(less[k] == (a[k] < b[k] ? a[k] : b[k]));
    assert_true(more[k] == (a[k] > b[k] ? a[k] : b[k]));
    assert_true(root[k] == (a[k] < 0.0f ? -a[k] : a[k]));
    assert_true(kept[k] == (a[k] < b[k] ? a[k] : 0.0f));
  }
}

static void products_are_those_of_vectors(void **state) {
  CwEight u[3], v[3], n[3];
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 8; k++) u[i][k] = (float)(i + 2 * k + 1), v[i][k] = (float)(3 * i * i - k);
  }
  CwEight dot = cw_eight_dot(u, v);
  cw_eight_cross(u, v, n);
  for (int k = 0; k < 8; k++) {
    assert_true(dot[k] == u[0][k] * v[0][k] + u[1][k] * v[1][k] + u[2][k] * v[2][k]);
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3, l = (i + 2) % 3;
      assert_true(n[i][k] == u[j][k] * v[l][k] - u[l][k] * v[j][k]);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_of_each_half_become_columns),
      cmocka_unit_test(halves_are_side_by_side),
      cmocka_unit_test(each_of_eight_has_its_own),
      cmocka_unit_test(products_are_those_of_vectors),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
