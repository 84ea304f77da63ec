// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>

#include "mesher/common/four.h"

static void rows_become_columns(void **state) {
  CwFour v[4];
  for (int k = 0; k < 16; k++) v[k / 4][k % 4] = (float)k;
  cw_four_turn(v);
  for (int k = 0; k < 16; k++) assert_true(v[k % 4][k / 4] == (float)k);
}

static void each_of_four_has_its_own(void **state) {
  const CwFour a = {1.0f, 4.0f, -2.0f, 9.0f}, b = {2.0f, 3.0f, -3.0f, 9.0f};
  CwFour less = cw_four_less(a, b), more = cw_four_more(a, b), root = cw_four_sqrt(a * a), kept = cw_four_if(a < b, a);
  for (int k = 0; k < 4; k++) {
    assert_true(less[k] == (a[k] < b[k] ? a[k] : b[k]));
    assert_true(more[k] == (a[k] > b[k] ? a[k] : b[k]));
    assert_true(root[k] == (a[k] < 0.0f ? -a[k] : a[k]));
    assert_true(kept[k] == (a[k] < b[k] ? a[k] : 0.0f));
  }
}

// The difference is taken first: what is left of two places far from the origin is not rounded with them.
static void a_way_is_rounded_once(void **state) {
  const double from[3] = {1e6, -1e6, 1e6 + 1e-4}, to[3] = {1e6 + 1e-3, -1e6 + 2e-3, 1e6};
  CwFour way = cw_four_way(from, to);
  for (int i = 0; i < 3; i++) assert_true(way[i] == (float)(to[i] - from[i]));
  assert_true(way[3] == 0.0f);
}

static void products_are_those_of_vectors(void **state) {
  CwFour u[3], v[3], n[3];
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 4; k++) u[i][k] = (float)(i + 2 * k + 1), v[i][k] = (float)(3 * i * i - k);
  }
  CwFour dot = cw_four_dot(u, v);
  cw_four_cross(u, v, n);
  for (int k = 0; k < 4; k++) {
    assert_true(dot[k] == u[0][k] * v[0][k] + u[1][k] * v[1][k] + u[2][k] * v[2][k]);
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3, l = (i + 2) % 3;
      assert_true(n[i][k] == u[j][k] * v[l][k] - u[l][k] * v[j][k]);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_become_columns),
      cmocka_unit_test(each_of_four_has_its_own),
      cmocka_unit_test(a_way_is_rounded_once),
      cmocka_unit_test(products_are_those_of_vectors),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
