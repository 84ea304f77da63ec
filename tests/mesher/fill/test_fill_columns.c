// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "closed_surfaces.h"
#include "mesher/fill/fill_columns.h"

#define NEAR(value, wanted, tolerance) assert_true(fabs((value) - (wanted)) <= (tolerance))

static const double origin[3] = {0, 0, 0};

// Lines through the inside, an edge and corners of a box; beside it.
static void box_is_cut_in_two_places(void **unused) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 1}, (double[3]){4, 4, 3}, (int[3]){4, 4, 2}, 1);
  CwFillInput input = surface_fill_input(&s, NULL, NULL);
  CwColumns *columns = NULL;
  int32_t count;
  const double *z;
  assert_int_equal(cw_columns_make(&input, &columns), CW_OK);
  for (int k = 0; k < 81; k++) {
    double x = 0.5 * (k % 9), y = 0.5 * (k / 9); // on lines and corners of the triangles too
    assert_int_equal(cw_columns_cut(columns, x, y, &count, &z), CW_OK);
    assert_int_equal(count % 2, 0);
    if (k % 9 == 0 || k % 9 == 8 || k / 9 == 0 || k / 9 == 8) continue; // upright walls: either
    assert_int_equal(count, 2);
    NEAR(fmin(z[0], z[1]), 1.0, 1e-14);
    NEAR(fmax(z[0], z[1]), 3.0, 1e-14);
  }
  assert_int_equal(cw_columns_cut(columns, -0.1, 2.0, &count, &z), CW_OK);
  assert_int_equal(count, 0);
  assert_int_equal(cw_columns_cut(columns, 2.0, 400.0, &count, &z), CW_OK);
  assert_int_equal(count, 0);
  cw_columns_free(&columns);
  surface_free(&s);
}

static int compare_doubles(const void *a, const void *b) {
  return (*(const double *)a > *(const double *)b) - (*(const double *)a < *(const double *)b);
}

static void ball_with_a_void_is_cut_in_four(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 1.0, 4, 1);
  surface_add_sphere(&s, origin, 0.5, 4, 0);
  CwFillInput input = surface_fill_input(&s, NULL, NULL);
  CwColumns *columns = NULL;
  int32_t count;
  const double *z;
  assert_int_equal(cw_columns_make(&input, &columns), CW_OK);
  for (int k = 0; k < 100; k++) {
    double x = 0.004 * k, y = 0.07, four[4];
    assert_int_equal(cw_columns_cut(columns, x, y, &count, &z), CW_OK);
    assert_int_equal(count, 4);
    memcpy(four, z, sizeof four);
    qsort(four, 4, sizeof *four, compare_doubles);
    double square = x * x + y * y;
    NEAR(four[0], -sqrt(1.0 - square), 0.01);
    NEAR(four[1], -sqrt(0.25 - square), 0.01);
    NEAR(four[2], sqrt(0.25 - square), 0.01);
    NEAR(four[3], sqrt(1.0 - square), 0.01);
  }
  cw_columns_free(&columns);
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(box_is_cut_in_two_places),
      cmocka_unit_test(ball_with_a_void_is_cut_in_four),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
