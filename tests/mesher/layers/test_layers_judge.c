// SPDX-License-Identifier: AGPL-3.0-or-later
// Which prisms are repaired, and which of their columns give way: one prism by hand.
#include <math.h>

#include "mesher/layers/layers_judge.h"
#include "mesher/policy.h"
#include "tests/unit_test.h"

// Over the triangle (0,0) (1,0) (0,1), upright columns of height 0.3; that of the first is `tall`.
typedef struct {
  CwLayerInput in;
  CwLayerWork work;
  double top[3][3], t[3], base_cos[3], least[3];
} One;

static void make(One *one, double tall) {
  static const double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  static const int32_t triangle[1][3] = {{0, 2, 1}}; // normal out of the domain, which lies above
  *one = (One){.in = {.point_count = 3, .x = x, .triangle_count = 1, .triangle = triangle}};
  one->in.least = one->least;
  one->work = (CwLayerWork){.in = &one->in, .n = 3, .t = one->t, .base_cos = one->base_cos};
  for (int v = 0; v < 3; v++) {
    for (int k = 0; k < 2; k++) one->top[v][k] = x[v][k];
    one->top[v][2] = one->t[v] = v == 0 ? tall : 0.3;
    one->base_cos[v] = 1;
  }
}

// A column that stands out: the layer top has a normal along (d, d, 1) for d more height, and edges of the root of
// 1 + d^2 there, so that the quality is 1 / (1 + d^2), and that of the layer top too. Less of that column alone helps.
// Where it may give nothing for the shape all are thinned; for soundness it gives way all the same.
static void column_that_helps(void **state) {
  const double more = 4.5;
  One one;
  int helps[3];
  make(&one, 0.3 + more);
  const double(*top)[3] = (const double(*)[3])one.top;
  assert_near(cw_layers_judge(&one.work, 0, top), cw_policy.turn_top / (1 + more * more), 1e-12);
  assert_false(cw_layers_is_sound(&one.work, 0, top));
  for (int floor = 0; floor < 2; floor++) {
    one.least[0] = floor ? one.t[0] : 0;
    for (int sound = 0; sound < 2; sound++) {
      cw_layers_helped_by(&one.work, 0, top, sound, helps);
      int all = floor && sound; // the corners are 0, 2, 1
      assert_int_equal(helps[0], 1);
      assert_int_equal(helps[1], all);
      assert_int_equal(helps[2], all);
    }
  }
  make(&one, 0.3); // a right prism: no column helps
  cw_layers_helped_by(&one.work, 0, (const double(*)[3])one.top, 1, helps);
  for (int k = 0; k < 3; k++) assert_int_equal(helps[k], 1);
}

// Columns that all lean to a cosine of 0.1: asked for better, unless the walls about one of them allow no more.
static void columns_that_must_lean(void **state) {
  One one;
  make(&one, 0.3);
  for (int v = 0; v < 3; v++) one.top[v][0] += 0.3 * tan(acos(0.1));
  const double(*top)[3] = (const double(*)[3])one.top;
  double quality = cw_layers_judge(&one.work, 0, top);
  assert_near(quality, 0.1, 1e-12);
  assert_true(quality < cw_policy.prism_good);
  for (int v = 0; v < 3; v++) {
    const double most = 0.1 / 0.6; // of which the columns keep 0.6
    one.base_cos[v] = 0.99 * most;
    assert_true(cw_layers_judge(&one.work, 0, top) >= cw_policy.prism_good);
    assert_true(cw_layers_is_sound(&one.work, 0, top));
    one.base_cos[v] = 1.01 * most;
    assert_near(cw_layers_judge(&one.work, 0, top), 0.1, 1e-12);
    one.base_cos[v] = 1;
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(column_that_helps),
      cmocka_unit_test(columns_that_must_lean),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
