// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gmp.h>
#include <math.h>
#include <string.h>

#include "mesher/common/predicates.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// The same determinants in rational numbers: row k is point k minus the last one, with its square where
// `lift`.
static int judge(int n, const double *const point[], int lift) {
  mpq_t m[4][4], t;
  int rows = n - 1, sign = 1;
  mpq_init(t);
  for (int r = 0; r < rows; r++) {
    for (int c = 0; c < rows; c++) mpq_init(m[r][c]);
    for (int c = 0; c < 3; c++) {
      mpq_set_d(m[r][c], point[r][c]);
      mpq_set_d(t, point[rows][c]);
      mpq_sub(m[r][c], m[r][c], t);
    }
    for (int c = 0; lift && c < 3; c++) {
      mpq_mul(t, m[r][c], m[r][c]);
      mpq_add(m[r][3], m[r][3], t);
    }
  }
  for (int k = 0; k < rows && sign; k++) { // elimination with the first pivot that is not zero
    int pivot = k;
    while (pivot < rows && mpq_sgn(m[pivot][k]) == 0) pivot++;
    if (pivot == rows) {
      sign = 0;
      break;
    }
    if (pivot != k) {
      sign = -sign;
      for (int c = 0; c < rows; c++) mpq_swap(m[k][c], m[pivot][c]);
    }
    sign *= mpq_sgn(m[k][k]);
    for (int r = k + 1; r < rows; r++) {
      mpq_t factor;
      mpq_init(factor);
      mpq_div(factor, m[r][k], m[k][k]);
      for (int c = k; c < rows; c++) {
        mpq_mul(t, factor, m[k][c]);
        mpq_sub(m[r][c], m[r][c], t);
      }
      mpq_clear(factor);
    }
  }
  for (int r = 0; r < rows; r++) {
    for (int c = 0; c < rows; c++) mpq_clear(m[r][c]);
  }
  mpq_clear(t);
  return sign;
}

static uint64_t state = 20240611;

static double small_integer(int range) {
  return draw_below(&state, 2 * range + 1) - range;
}

// In terms of the judge's rows: det (a - d, b - d, c - d) is minus our sign of (b - a) x (c - a) . (d - a).
static void check(const double p[5][3]) {
  const double *four[4] = {p[0], p[1], p[2], p[3]}, *five[5] = {p[0], p[1], p[2], p[3], p[4]};
  int orient = -judge(4, four, 0);
  assert_int_equal(cw_orient3d(p[0], p[1], p[2], p[3]), orient);
  assert_int_equal(cw_orient3d_exact(p[0], p[1], p[2], p[3]), orient);
  // Of a positive tetrahedron (0, x, y, z) and a point far away: rows give +, outside.
  int sphere = -judge(5, five, 1);
  assert_int_equal(cw_insphere(p[0], p[1], p[2], p[3], p[4]), sphere);
  assert_int_equal(cw_insphere_exact(p[0], p[1], p[2], p[3], p[4]), sphere);
}

static void known_by_hand(void **unused) {
  const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0}, d[3] = {0, 0, 1};
  const double flat[3] = {0.3, 0.4, 0}, in[3] = {0.5, 0.5, 0.5}, on[3] = {1, 1, 1}, out[3] = {1, 1, 1 + 1e-15};
  assert_int_equal(cw_orient3d(a, b, c, d), 1);
  assert_int_equal(cw_orient3d(a, c, b, d), -1);
  assert_int_equal(cw_orient3d(a, b, c, flat), 0);
  assert_int_equal(cw_insphere(a, b, c, d, in), 1);
  assert_int_equal(cw_insphere(a, b, c, d, on), 0);
  assert_int_equal(cw_insphere(a, b, c, d, out), -1);
  assert_int_equal(cw_insphere(a, c, b, d, in), -1);
}

// Many exact zeros: points of a small grid.
static void small_integers(void **unused) {
  int zeros = 0;
  for (int round = 0; round < 4000; round++) {
    double p[5][3];
    for (int k = 0; k < 15; k++) p[k / 3][k % 3] = small_integer(round % 2 ? 2 : 9);
    check((const double(*)[3])p);
    zeros += cw_insphere(p[0], p[1], p[2], p[3], p[4]) == 0;
  }
  assert_true(zeros > 200);
}

// Points of a grid that no power of two divides, moved by one unit in the last place here and there.
static void nearly_degenerate(void **unused) {
  for (int round = 0; round < 4000; round++) {
    double p[5][3];
    for (int k = 0; k < 15; k++) {
      double *x = &p[k / 3][k % 3];
      *x = 0.1 + 1e-3 * small_integer(3);
      if (draw_below(&state, 3) == 0) *x = nextafter(*x, draw_below(&state, 2) ? 1.0 : -1.0);
    }
    check((const double(*)[3])p);
  }
}

// Sizes so different that the differences themselves are not exact.
static void mixed_sizes(void **unused) {
  for (int round = 0; round < 2000; round++) {
    double p[5][3];
    for (int k = 0; k < 15; k++) {
      p[k / 3][k % 3] = ldexp(small_integer(1 << 20) + 0.125 * small_integer(4), draw_below(&state, 60) - 40);
    }
    if (round % 2) { // the last on the line of the first two, as nearly as can be
      for (int i = 0; i < 3; i++) p[3][i] = p[4][i] = 0.5 * (p[0][i] + p[1][i]);
    }
    check((const double(*)[3])p);
  }
}

static void turned_corners_turn_the_sign(void **unused) {
  for (int round = 0; round < 500; round++) {
    double p[5][3];
    for (int k = 0; k < 15; k++) p[k / 3][k % 3] = 0.05 + 1e-4 * small_integer(4);
    int orient = cw_orient3d(p[0], p[1], p[2], p[3]), sphere = cw_insphere(p[0], p[1], p[2], p[3], p[4]);
    assert_int_equal(cw_orient3d(p[1], p[0], p[2], p[3]), -orient);
    assert_int_equal(cw_orient3d(p[1], p[2], p[0], p[3]), orient);
    assert_int_equal(cw_insphere(p[1], p[0], p[2], p[3], p[4]), -sphere);
    assert_int_equal(cw_insphere(p[1], p[2], p[3], p[0], p[4]), -sphere);
    assert_int_equal(cw_insphere(p[4], p[1], p[2], p[3], p[0]), -sphere);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(known_by_hand),
      cmocka_unit_test(small_integers),
      cmocka_unit_test(nearly_degenerate),
      cmocka_unit_test(mixed_sizes),
      cmocka_unit_test(turned_corners_turn_the_sign),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
