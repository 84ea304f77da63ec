// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "closed_surfaces.h"
#include "mesher/common/verticals.h"
#include "pipeline/order.h"
#include "tests/unit_test.h"

static const double origin[3] = {0, 0, 0};

static CwVerticals *verticals_of(const Surface *s) {
  CwVerticals *verticals = NULL;
  assert_int_equal(
      cw_verticals_make((const double(*)[3])s->x, s->triangle_count, (const int32_t(*)[3])s->triangle, &verticals),
      CW_OK);
  return verticals;
}

// Lines through the inside, an edge and corners of a box; beside it.
static void box_is_cut_in_two_places(void **unused) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 1}, (double[3]){4, 4, 3}, (int[3]){4, 4, 2}, 1);
  CwVerticals *verticals = verticals_of(&s);
  int32_t count;
  const double *z;
  for (int k = 0; k < 81; k++) {
    double x = 0.5 * (k % 9), y = 0.5 * (k / 9); // on lines and corners of the triangles too
    assert_int_equal(cw_verticals_cut(verticals, x, y, &count, &z), CW_OK);
    assert_int_equal(count % 2, 0);
    if (k % 9 == 0 || k % 9 == 8 || k / 9 == 0 || k / 9 == 8) continue; // upright walls: either
    assert_int_equal(count, 2);
    assert_near(fmin(z[0], z[1]), 1.0, 1e-14);
    assert_near(fmax(z[0], z[1]), 3.0, 1e-14);
  }
  assert_int_equal(cw_verticals_cut(verticals, -0.1, 2.0, &count, &z), CW_OK);
  assert_int_equal(count, 0);
  assert_int_equal(cw_verticals_cut(verticals, 2.0, 400.0, &count, &z), CW_OK);
  assert_int_equal(count, 0);
  cw_verticals_free(&verticals);
  surface_free(&s);
}

static void ball_with_a_void_is_cut_in_four(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 1.0, 4, 1);
  surface_add_sphere(&s, origin, 0.5, 4, 0);
  CwVerticals *verticals = verticals_of(&s);
  int32_t count;
  const double *z;
  for (int k = 0; k < 100; k++) {
    double x = 0.004 * k, y = 0.07, four[4];
    assert_int_equal(cw_verticals_cut(verticals, x, y, &count, &z), CW_OK);
    assert_int_equal(count, 4);
    memcpy(four, z, sizeof four);
    qsort(four, 4, sizeof *four, cw_order_doubles);
    double square = x * x + y * y;
    assert_near(four[0], -sqrt(1.0 - square), 0.01);
    assert_near(four[1], -sqrt(0.25 - square), 0.01);
    assert_near(four[2], sqrt(0.25 - square), 0.01);
    assert_near(four[3], sqrt(1.0 - square), 0.01);
  }
  cw_verticals_free(&verticals);
  surface_free(&s);
}

// Lines run exactly through corners, edges and diagonals of the grid of the box.
static void box_at_its_own_grid_points(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){4, 4, 4}, (int[3]){4, 4, 4}, 1);
  CwVerticals *verticals = verticals_of(&s);
  for (int i = -2; i <= 10; i++) {
    for (int j = -2; j <= 10; j++) {
      for (int k = -2; k <= 10; k++) {
        if (i == 0 || i == 8 || j == 0 || j == 8 || k == 0 || k == 8) continue; // on the surface
        int wanted = i > 0 && i < 8 && j > 0 && j < 8 && k > 0 && k < 8;
        assert_int_equal(cw_verticals_inside(verticals, (double[3]){0.5 * i, 0.5 * j, 0.5 * k}), wanted);
      }
    }
  }
  cw_verticals_free(&verticals);
  surface_free(&s);
}

static void voids_are_outside_and_what_is_in_them_inside(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 3.0, 3, 1);
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 2.0, 3, 0);
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 1.0, 2, 1);
  CwVerticals *verticals = verticals_of(&s);
  for (int k = 0; k < 7; k++) {
    double r = 0.5 * k;
    int wanted = r < 0.9 || (r > 2.0 && r < 2.9);
    if (k == 2 || k == 4 || k == 6) continue;
    assert_int_equal(cw_verticals_inside(verticals, (double[3]){r, 0, 0}), wanted);
    assert_int_equal(cw_verticals_inside(verticals, (double[3]){0, -r, 0}), wanted);
    assert_int_equal(cw_verticals_inside(verticals, (double[3]){0, 0, r}), wanted);
    assert_int_equal(cw_verticals_inside(verticals, (double[3]){0.6 * r, 0, -0.8 * r}), wanted);
  }
  cw_verticals_free(&verticals);
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(box_is_cut_in_two_places),
      cmocka_unit_test(ball_with_a_void_is_cut_in_four),
      cmocka_unit_test(box_at_its_own_grid_points),
      cmocka_unit_test(voids_are_outside_and_what_is_in_them_inside),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
