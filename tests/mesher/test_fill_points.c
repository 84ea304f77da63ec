// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesher/fill_points.h"
#include "closed_surfaces.h"

static double size_at(const void *context, const double x[3]) {
  const double *f = context; // size at x = 0 and growth along x
  return f[0] + f[1] * fabs(x[0]);
}

static int32_t points_in(const double low[3], const double high[3], const int n[3], const double field[2],
                         double (**x)[3], Surface *s) {
  surface_add_box(s, low, high, n, 1);
  CwFillInput input = {.point_count = s->point_count,
                       .x = (const double(*)[3])s->x,
                       .triangle_count = s->triangle_count,
                       .triangle = (const int32_t(*)[3])s->triangle,
                       .size = size_at,
                       .size_context = field,
                       .name = "box"};
  int32_t count;
  assert_int_equal(cw_fill_points(&input, 1.0, &count, x), CW_OK);
  return count;
}

static void lattice_has_the_asked_density_and_keeps_its_distance(void **state) {
  Surface s = {0};
  double(*x)[3];
  const double field[2] = {0.002, 0.0};
  int32_t count =
      points_in((double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){20, 20, 20}, field, &x, &s);
  int32_t core = 0;
  for (int32_t i = 0; i < count; i++) {
    int within = 1;
    for (int k = 0; k < 3; k++) {
      assert_true(x[i][k] > 0.6 * 0.002 && x[i][k] < 0.04 - 0.6 * 0.002);
      within &= x[i][k] > 0.01 && x[i][k] < 0.03;
    }
    core += within;
  }
  // Two points in a cube of edge 2^(1/6) h: sqrt(2) in h^3; a thousand h^3 in the core, whose faces fall
  // between planes of the lattice: 17 or 18 half cells along each edge.
  assert_true(core > 0.85 * 1414 && core < 1.15 * 1414);
  free(x);
  surface_free(&s);
}

static void two_shapes_of_one_size_field_agree_in_density(void **state) {
  Surface s = {0};
  double(*x)[3];
  const double field[2] = {0.001, 0.04}; // 1 mm to 2.6 mm along 40 mm
  int32_t count =
      points_in((double[3]){0, 0, 0}, (double[3]){0.04, 0.02, 0.02}, (int[3]){40, 20, 20}, field, &x, &s);
  double wanted = 0.0; // integral of sqrt(2) / h^3 less the shell of 0.6 h
  for (int k = 0; k < 1000; k++) {
    double at = 0.04 * (k + 0.5) / 1000.0, h = field[0] + field[1] * at, side = 0.02 - 1.24 * h;
    wanted += sqrt(2.0) * side * side * 0.04 / 1000.0 / (h * h * h);
  }
  assert_true(count > 0.8 * wanted && count < 1.2 * wanted);
  free(x);
  surface_free(&s);
}

static void nothing_fits_into_a_gap_below_the_size(void **state) {
  Surface s = {0};
  double(*x)[3];
  const double field[2] = {0.002, 0.0};
  int32_t count =
      points_in((double[3]){0, 0, 0}, (double[3]){0.02, 0.02, 0.002}, (int[3]){10, 10, 1}, field, &x, &s);
  assert_int_equal(count, 0);
  free(x);
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lattice_has_the_asked_density_and_keeps_its_distance),
      cmocka_unit_test(two_shapes_of_one_size_field_agree_in_density),
      cmocka_unit_test(nothing_fits_into_a_gap_below_the_size),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
