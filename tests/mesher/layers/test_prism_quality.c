// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/layers/prism_quality.h"
#include "tests/unit_test.h"

// Right, half as wide at the end, drawn out by a column that leans by 45 degrees, closed to a point, turned inside out;
// tapered to a corner, and turned inside out there.
static void prisms_by_hand(void **state) {
  const double wall[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, *const a[3] = {wall[0], wall[1], wall[2]};
  const struct {
    double x[3][3], quality;
  } prism[] = {{{{0, 0, -2}, {1, 0, -2}, {0, 1, -2}}, 1},
               {{{0.25, 0.25, -2}, {0.75, 0.25, -2}, {0.25, 0.75, -2}}, 2 / sqrt(4.125)},
               {{{0, 0, -1}, {2, 0, -1}, {0, 1, -1}}, 1 / sqrt(5)},
               {{{0, 0, -1}, {0, 0, -1}, {0, 0, -1}}, -1},
               {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, -1},
               {{{0, 0, 0}, {1, 0, -2}, {0, 1, -2}}, 1 / sqrt(5)},
               {{{0, 0, 0}, {1, 0, 2}, {0, 1, 2}}, -1}};
  for (size_t i = 0; i < sizeof prism / sizeof *prism; i++) {
    const double *const b[3] = {prism[i].x[0], prism[i].x[1], prism[i].x[2]};
    assert_near(cw_prism_quality(a, b), prism[i].quality, 1e-12);
  }
}

// What is left of a triangle that is moved, shrunk, drawn out to twice its height, squashed to a quarter of it, turned
// upright, turned over.
static void top_by_hand(void **state) {
  const double wall[3][3] = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, *const a[3] = {wall[0], wall[1], wall[2]};
  const struct {
    double x[3][3], quality;
  } top[] = {{{{-1, 0, -2}, {1, 0, -2}, {0, 1, -2}}, 1},   {{{-0.5, 0, -2}, {0.5, 0, -2}, {0, 0.5, -2}}, 1},
             {{{-1, 0, -2}, {1, 0, -2}, {0, 2, -2}}, 0.8}, {{{-1, 0, -2}, {1, 0, -2}, {0, 0.25, -2}}, sqrt(2 / 17.0)},
             {{{-1, 0, -2}, {1, 0, -2}, {0, 0, -1}}, 0},   {{{-1, 0, -2}, {1, 0, -2}, {0, -1, -2}}, -1}};
  for (size_t i = 0; i < sizeof top / sizeof *top; i++) {
    const double *const b[3] = {top[i].x[0], top[i].x[1], top[i].x[2]};
    assert_near(cw_prism_top_quality(a, b), top[i].quality, 1e-14);
  }
}

// On a triangle with sides of 3, 4 and 5: upright; sheared across the side of 4 by 30, as one layer and as two; upright
// and as sheared, but too thin in any case.
static void shear_by_hand(void **state) {
  const double wall[3][3] = {{0, 0, 0}, {0, 4, 0}, {3, 0, 0}}, *const a[3] = {wall[0], wall[1], wall[2]};
  const struct {
    double height, shift;
    int layers;
  } prism[] = {{2, 0, 1}, {2, 30, 1}, {2, 30, 2}, {0.02, 0, 1}, {0.02, 0.1, 1}};
  for (size_t i = 0; i < sizeof prism / sizeof *prism; i++) {
    double x[3][3], h = prism[i].height / prism[i].layers, s = prism[i].shift / prism[i].layers;
    for (int k = 0; k < 3; k++)
      for (int c = 0; c < 3; c++) x[k][c] = wall[k][c] + (c == 0 ? prism[i].shift : c == 2 ? prism[i].height : 0);
    // The lowest, on the wall, is the least: 3/2 A^4 h^4 / a^6, a the mean of its triangle and its sides.
    double mean = (6 + 3 * h + 4 * hypot(h, s) + 5 * hypot(h, 0.8 * s)) / 4;
    double wanted = i == 1 || i == 2 ? 1.5 * pow(6 * h, 4) / pow(mean, 6) / 1.05e-3 : 1;
    const double *const b[3] = {x[0], x[1], x[2]}, part = 1.0 / prism[i].layers, even[3] = {part, part, part};
    assert_near(cw_prism_shear_quality(a, b, prism[i].layers, even), wanted, 1e-12);
    assert_true(wanted == 1 || wanted < 0.1);
  }
  // Sheared by 10: five even layers are fine; were the last one the whole column, it would not be. It is an inner one:
  // 3 A^4 h^4 / a^6.
  double x[3][3], h = 2, s = 10;
  for (int k = 0; k < 3; k++)
    for (int c = 0; c < 3; c++) x[k][c] = wall[k][c] + (c == 0 ? s : c == 2 ? h : 0);
  const double *const b[3] = {x[0], x[1], x[2]}, even[3] = {0.2, 0.2, 0.2}, whole[3] = {1, 1, 1};
  double mean = (2 * 6 + 3 * h + 4 * hypot(h, s) + 5 * hypot(h, 0.8 * s)) / 5;
  double wanted = 3 * pow(6 * h, 4) / pow(mean, 6) / 1.05e-3;
  print_message("  sheared: %.2f of what is asked with one layer to the top, %.2f with even ones\n", wanted,
                cw_prism_shear_quality(a, b, 5, even));
  assert_true(wanted < 1);
  assert_near(cw_prism_shear_quality(a, b, 5, whole), wanted, 1e-12);
  assert_near(cw_prism_shear_quality(a, b, 5, even), 1, 1e-12);
}

// On the unit right triangle, 1 high, with the end of the column at its right angle moved into the prism by (s, s): the
// halves of the pyramids on the sides beside it are (2 + s) / 6, twice (1 - s) / 3, and (2 - 5 s) / 6 at the upper end
// of the other column.
static void sides_by_hand(void **state) {
  const double wall[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, *const a[3] = {wall[0], wall[1], wall[2]};
  for (int i = 0; i <= 8; i++) {
    double s = 0.1 * i, x[3][3] = {{s, s, 1}, {1, 0, 1}, {0, 1, 1}}, least = (2 - 5 * s) / (2 - 2 * s);
    const double *const b[3] = {x[0], x[1], x[2]}, one[3] = {1, 1, 1};
    assert_near(cw_prism_shear_quality(a, b, 1, one), fmin(1, least / 0.1), 1e-12);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(prisms_by_hand), cmocka_unit_test(top_by_hand),
                                     cmocka_unit_test(shear_by_hand), cmocka_unit_test(sides_by_hand)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
