// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "mesher/kernel_columns.h"
#include "mesher/kernel_points.h"
#include "closed_surfaces.h"

#define NEAR(value, wanted, tolerance) assert_true(fabs((value) - (wanted)) <= (tolerance))

typedef struct {
  double size, growth; // size + growth * |x|
} Field;

static double size_at(const void *context, const double x[3]) {
  const Field *f = context;
  return f->size + f->growth * sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

static CwFillInput input_of(const Surface *s, const Field *field) {
  return (CwFillInput){.point_count = s->point_count,
                       .x = (const double(*)[3])s->x,
                       .triangle_count = s->triangle_count,
                       .triangle = (const int32_t(*)[3])s->triangle,
                       .size = size_at,
                       .size_context = field,
                       .name = "rotor region 3"};
}

static const double origin[3] = {0, 0, 0};

// Lines through the inside, an edge and corners of a box; beside it.
static void box_is_cut_in_two_places(void **unused) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 1}, (double[3]){4, 4, 3}, (int[3]){4, 4, 2}, 1);
  Field field = {1, 0};
  CwFillInput input = input_of(&s, &field);
  CwColumns *columns = NULL;
  int32_t count;
  const double *z;
  assert_int_equal(cw_columns_make(&input, &columns), CW_OK);
  for (int k = 0; k < 81; k++) {
    double x = 0.5 * (k % 9), y = 0.5 * (k / 9); // on lines and corners of the triangles too
    assert_int_equal(cw_columns_cut(columns, x, y, &count, &z), CW_OK);
    assert_int_equal(count % 2, 0);
    if (k % 9 == 0 || k % 9 == 8 || k / 9 == 0 || k / 9 == 8)
      continue; // upright walls: either
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
  Field field = {1, 0};
  CwFillInput input = input_of(&s, &field);
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

static int32_t make(const Surface *s, const Field *field, double (**x)[3]) {
  CwFillInput input = input_of(s, field);
  int32_t count;
  if (cw_kernel_points(&input, &count, x) != CW_OK)
    fail_msg("%s", cw_fail_message());
  return count;
}

// Two points a cell of the lattice, 0.62 h off the sphere (whose triangles cut a little more).
static void uniform_ball_with_a_void(void **unused) {
  Surface s = {0};
  double(*x)[3], h = 0.0036, a = 1.122462048309373 * h;
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  surface_add_sphere(&s, origin, 0.02, 3, 0);
  Field field = {h, 0};
  int32_t count = make(&s, &field, &x);
  for (int32_t p = 0; p < count; p++) {
    double r = sqrt(x[p][0] * x[p][0] + x[p][1] * x[p][1] + x[p][2] * x[p][2]);
    assert_true(r < 0.05 - 0.6 * h && r > 0.02 + 0.55 * h);
  }
  double low = 0.02 + 0.62 * h, high = 0.05 - 0.66 * h;
  double wanted = 4.0 / 3.0 * 3.141592653589793 * (pow(high, 3) - pow(low, 3)) * 2.0 / (a * a * a);
  assert_true(count > 0.9 * wanted && count < 1.05 * wanted);
  free(x);
  surface_free(&s);
}

// As many points as a field asks for that grows by a factor of 2.4: cells double, but the sum is fitted.
static void graded_ball(void **unused) {
  Surface s = {0};
  double(*x)[3], lattice = 1.122462048309373, wanted = 0.0;
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  Field field = {0.0015, 0.045};
  int32_t count = make(&s, &field, &x), inner = 0;
  for (int32_t p = 0; p < count; p++)
    inner += x[p][0] * x[p][0] + x[p][1] * x[p][1] + x[p][2] * x[p][2] < 2.116e-3;
  for (int k = 0; k < 1000; k++) { // integral of 2 / a^3 over the ball of radius 0.046
    double r = 0.046 * (k + 0.5) / 1000, at[3] = {r, 0, 0}, a = lattice * size_at(&field, at);
    wanted += 4.0 * 3.141592653589793 * r * r * 0.046 / 1000 * 2.0 / (a * a * a);
  }
  assert_true(inner > 0.85 * wanted && inner < 1.15 * wanted);
  free(x);
  surface_free(&s);
}

static void equal_bits_twice_and_no_duplicates(void **unused) {
  Surface s = {0};
  double(*one)[3], (*two)[3];
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.03, 0.02}, (int[3]){10, 8, 5}, 1);
  Field field = {0.003, 0.02};
  int32_t count = make(&s, &field, &one);
  assert_int_equal(make(&s, &field, &two), count);
  assert_memory_equal(one, two, (size_t)count * sizeof *one);
  for (int32_t p = 0; p < count; p++) {
    for (int i = 0; i < 3; i++)
      assert_true(one[p][i] > 0.0 && one[p][i] < 0.04);
    for (int32_t q = 0; q < p; q++) {
      double d = hypot(hypot(one[p][0] - one[q][0], one[p][1] - one[q][1]), one[p][2] - one[q][2]);
      assert_true(d > 0.001);
    }
  }
  free(one);
  free(two);
  surface_free(&s);
}

static void wrong_size_field_is_an_error(void **unused) {
  Surface s = {0};
  double(*x)[3];
  int32_t count;
  surface_add_sphere(&s, origin, 0.05, 1, 1);
  Field field = {0, 0};
  CwFillInput input = input_of(&s, &field);
  assert_int_equal(cw_kernel_points(&input, &count, &x), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "size field"));
  field.size = 1e-9;
  assert_int_equal(cw_kernel_points(&input, &count, &x), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "1e-5 of the region"));
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(box_is_cut_in_two_places),           cmocka_unit_test(ball_with_a_void_is_cut_in_four),
      cmocka_unit_test(uniform_ball_with_a_void),           cmocka_unit_test(graded_ball),
      cmocka_unit_test(equal_bits_twice_and_no_duplicates), cmocka_unit_test(wrong_size_field_is_an_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
