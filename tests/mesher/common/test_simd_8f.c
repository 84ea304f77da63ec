// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>

#include "mesher/common/simd_8f.h"
#include "tests/unit_test.h"

static void rows_of_each_half_become_columns(void **state) {
  Cw8f v[4];
  for (int k = 0; k < 16; k++) v[k / 4][k % 4] = (float)k, v[k / 4][4 + k % 4] = (float)(100 + k);
  cw_8f_transpose(v);
  for (int k = 0; k < 16; k++) {
    assert_true(v[k % 4][k / 4] == (float)k);
    assert_true(v[k % 4][4 + k / 4] == (float)(100 + k));
  }
}

static void halves_are_side_by_side(void **state) {
  const Cw4f low = {1.0f, 2.0f, 3.0f, 4.0f}, high = {5.0f, 6.0f, 7.0f, 8.0f};
  Cw8f both = cw_8f_join(low, high);
  Cw4f again[2] = {cw_8f_low(both), cw_8f_high(both)};
  for (int k = 0; k < 8; k++) assert_true(both[k] == (float)(k + 1) && again[k / 4][k % 4] == both[k]);
}

static void each_of_eight_has_its_own(void **state) {
  const Cw8f a = {1.0f, 4.0f, -2.0f, 9.0f, 0.5f, 0.0f, -7.0f, 3.0f};
  const Cw8f b = {2.0f, 3.0f, -3.0f, 9.0f, 0.25f, 1.0f, 7.0f, -3.0f};
  Cw8f less = cw_8f_min(a, b), more = cw_8f_max(a, b), root = cw_8f_sqrt(a * a);
  Cw8f kept = cw_8f_if(a < b, a);
  for (int k = 0; k < 8; k++) {
    assert_true(less[k] == (a[k] < b[k] ? a[k] : b[k]));
    assert_true(more[k] == (a[k] > b[k] ? a[k] : b[k]));
    assert_true(root[k] == (a[k] < 0.0f ? -a[k] : a[k]));
    assert_true(kept[k] == (a[k] < b[k] ? a[k] : 0.0f));
  }
}

static void products_are_those_of_vectors(void **state) {
  Cw8f u[3], v[3], n[3];
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 8; k++) u[i][k] = (float)(i + 2 * k + 1), v[i][k] = (float)(3 * i * i - k);
  }
  Cw8f dot = cw_8f_dot(u, v);
  cw_8f_cross(u, v, n);
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
