// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "closed_surfaces.h"
#include "mesher/cad/inside.h"

static CwInside *inside_of(const Surface *s) {
  CwInside *inside = NULL;
  assert_int_equal(cw_inside_make(s->point_count, (const double(*)[3])s->x, s->triangle_count,
                                  (const int32_t(*)[3])s->triangle, &inside),
                   CW_OK);
  return inside;
}

// Rays run exactly through corners, edges and diagonals of the grid of the box.
static void box_at_its_own_grid_points(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){4, 4, 4}, (int[3]){4, 4, 4}, 1);
  CwInside *inside = inside_of(&s);
  for (int i = -2; i <= 10; i++) {
    for (int j = -2; j <= 10; j++) {
      for (int k = -2; k <= 10; k++) {
        if (i == 0 || i == 8 || j == 0 || j == 8 || k == 0 || k == 8) continue; // on the surface
        int wanted = i > 0 && i < 8 && j > 0 && j < 8 && k > 0 && k < 8;
        assert_int_equal(cw_inside_test(inside, (double[3]){0.5 * i, 0.5 * j, 0.5 * k}), wanted);
      }
    }
  }
  cw_inside_free(&inside);
  surface_free(&s);
}

static void voids_are_outside_and_what_is_in_them_inside(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 3.0, 3, 1);
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 2.0, 3, 0);
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 1.0, 2, 1);
  CwInside *inside = inside_of(&s);
  for (int k = 0; k < 7; k++) {
    double r = 0.5 * k;
    int wanted = r < 0.9 || (r > 2.0 && r < 2.9);
    if (k == 2 || k == 4 || k == 6) continue;
    assert_int_equal(cw_inside_test(inside, (double[3]){r, 0, 0}), wanted);
    assert_int_equal(cw_inside_test(inside, (double[3]){0, -r, 0}), wanted);
    assert_int_equal(cw_inside_test(inside, (double[3]){0, 0, r}), wanted);
    assert_int_equal(cw_inside_test(inside, (double[3]){0.6 * r, 0, -0.8 * r}), wanted);
  }
  cw_inside_free(&inside);
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(box_at_its_own_grid_points),
      cmocka_unit_test(voids_are_outside_and_what_is_in_them_inside),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
