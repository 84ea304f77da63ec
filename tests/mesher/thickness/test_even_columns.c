// SPDX-License-Identifier: AGPL-3.0-or-later
// Upright columns of two layers over the unit square, whose triangles have an area of 1/2 and 2 + sqrt(2) around.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/layers/thin_prism.h"
#include "mesher/policy.h"
#include "mesher/thickness/even_columns.h"
#include "mesher/thickness/layer_thickness.h"
#include "tests/unit_test.h"

static uint8_t reason[4]; // of the columns, for their thickness

// First height made of the four columns of so many layers where `asked` is, and the least determinant then; corners 0
// and 2 are on both triangles. spread: of the square that the columns end in.
static double make_spread(int layers, double asked, const double thickness[4], double spread, double made[4]) {
  double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, top[4][3];
  double first[4] = {asked, asked, asked, asked}, growth[4] = {1.2, 1.2, 1.2, 1.2}, own[4], least = 1;
  int32_t triangle[2][3] = {{0, 2, 1}, {0, 3, 2}}, source[2] = {0, 1};
  CwSurfaceMesh surface = {.vertex_count = 4, .x = x, .triangle_count = 2, .source = source};
  CwLayers columns = {.triangle = triangle, .top = top, .thickness = own, .reason = reason};
  CwColumnTargets targets = {.layer_count = layers, .vertex_count = 4, .first_height = first, .growth = growth};
  memcpy(own, thickness, sizeof own);
  memcpy(top, x, sizeof top);
  for (int k = 0; k < 8; k++) top[k / 2][k % 2] += (spread - 1) * (x[k / 2][k % 2] - 0.5);
  for (int v = 0; v < 4; v++) top[v][2] = thickness[v];
  assert_int_equal(cw_columns_divide(NULL, &targets, &surface, &columns), CW_OK);
  memcpy(made, columns.first_height, sizeof own);
  for (int t = 0; t < 2; t++) {
    double of[CW_LAYERS_MOST], corner[3];
    for (int k = 0; k < 3; k++) corner[k] = made[triangle[t][k]];
    cw_column_determinants(&targets, &surface, &columns, t, corner, of);
    for (int i = 0; i < layers; i++) least = fmin(least, of[i]);
  }
  free(columns.first_height);
  return least;
}

static void make(int layers, double asked, const double thickness[4], double made[4]) {
  make_spread(layers, asked, thickness, 1, made);
}

static double determinant(double thickness) {
  const double base[3][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  const double top[3][3] = {{0, 0, thickness}, {1, 0, thickness}, {1, 1, thickness}};
  return cw_prism_determinant(base, top, 0);
}

static void short_ones_until_none_is_small(void **state) {
  const double short_one = 0.06, start = short_one / (1 + cw_policy.least_growth);
  double made[4];
  assert_true(determinant(cw_policy.least_growth * start) < CW_SMALL_DETERMINANT &&
              determinant(short_one / 2) > CW_SMALL_DETERMINANT);
  make(2, 0.05, (double[4]){short_one, short_one, short_one, short_one}, made);
  for (int v = 0; v < 4; v++) assert_near(made[v], made[0], 1e-12);
  assert_near(made[0], start * pow(0.95, 4), 1e-12);
  assert_true(determinant(short_one - made[0]) > CW_SMALL_DETERMINANT);
  assert_true(determinant(short_one - made[0] / 0.95) < 1.05 * CW_SMALL_DETERMINANT);
}

// The last of two layers is 1.2 times as high as the first where they taper and have no room for a first of 50 mm.
static void tapered_ones_keep_their_growth(void **state) {
  double made[4];
  reason[1] = reason[3] = CW_LAYER_TAPER;
  make(2, 0.05, (double[4]){0.105, 0.105, 0.105, 0.12}, made);
  const double wanted[4] = {0.05, 0.105 / 2.2, 0.05, 0.05};
  for (int v = 0; v < 4; v++) assert_near(made[v], wanted[v], 1e-15);
  reason[1] = reason[3] = CW_LAYER_FULL;
}

static void others_stay(void **state) {
  double made[4];
  // Layers grow, or shrink and are high enough, or are so thin that even ones are small too.
  const double all[3] = {0.105, 0.09, 0.04};
  assert_true(determinant(0.04) > CW_SMALL_DETERMINANT && determinant(0.02) < CW_SMALL_DETERMINANT);
  for (int i = 0; i < 3; i++) {
    make(2, 0.05, (double[4]){all[i], all[i], all[i], all[i]}, made);
    for (int v = 0; v < 4; v++) assert_near(made[v], 0.05, 1e-12);
  }
  // Even ones would do, but not within a tenth of the first height, for which there is room: it stays.
  const double held = 0.038, column = held * (1 + cw_policy.least_growth) * 1.001;
  assert_true(determinant(column - 0.9 * held) < CW_SMALL_DETERMINANT &&
              determinant(column / 2) > CW_SMALL_DETERMINANT);
  make(2, held, (double[4]){column, column, column, column}, made);
  for (int v = 0; v < 4; v++) assert_near(made[v], held, 1e-12);
  // A tall column among short ones keeps its first height.
  make(2, 0.05, (double[4]){0.06, 0.06, 0.06, 0.11}, made);
  assert_true(made[1] < 0.06 / (1 + cw_policy.least_growth));
  assert_near(made[3], 0.05, 1e-12);
}

// Five layers that grow by 1.2, of which the second is the thinnest of the inner ones. With a greater first height it
// is thicker, and the last one thinner.
static void growing_ones_within_a_tenth(void **state) {
  for (int curable = 0; curable < 2; curable++) {
    double wanted = (curable ? 0.92 : 0.6) * CW_SMALL_DETERMINANT, second = 0.03, made[4], fraction[6];
    for (int i = 0; i < 20; i++) second *= pow(wanted / determinant(second), 0.25);
    double asked = second / 1.2, thickness = cw_layer_thickness(asked, 5, 1.2);
    make(5, asked, (double[4]){thickness, thickness, thickness, thickness}, made);
    cw_layer_fractions(thickness, made[0], 5, 1.2, fraction);
    double now = determinant((fraction[2] - fraction[1]) * thickness);
    print_message("  determinant %.5f, then %.5f with %.2f of the first height\n", wanted, now, made[0] / asked);
    for (int v = 0; v < 4; v++) assert_near(made[v], made[0], 1e-12);
    assert_true(curable ? now > CW_SMALL_DETERMINANT : made[0] == asked);
    assert_true(made[0] <= 1.09 * asked);
  }
}

// Right prisms over the wall would be tall enough; over the layer top, six times as wide, they are not.
static void those_that_lean_apart(void **state) {
  const double asked = 0.4, thickness = 0.54;
  double made[4];
  assert_true(make_spread(2, asked, (double[4]){thickness, thickness, thickness, thickness}, 1, made) >
              20 * CW_SMALL_DETERMINANT);
  for (int v = 0; v < 4; v++) assert_near(made[v], asked, 1e-12);
  double least = make_spread(2, asked, (double[4]){thickness, thickness, thickness, thickness}, 6, made);
  print_message("  least determinant %.5f with %.2f of the first height\n", least, made[0] / asked);
  assert_true(made[0] < asked);
  assert_true(least > CW_SMALL_DETERMINANT);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(short_ones_until_none_is_small),
                                     cmocka_unit_test(tapered_ones_keep_their_growth), cmocka_unit_test(others_stay),
                                     cmocka_unit_test(growing_ones_within_a_tenth),
                                     cmocka_unit_test(those_that_lean_apart)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
