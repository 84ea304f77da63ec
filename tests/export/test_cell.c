// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/cell.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

// The unit cube's corners, then its top centre.
static double points[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},  {0, 0, 1},
                             {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {.5, .5, 1}};
static int32_t tetrahedra[][4] = {{0, 1, 3, 4}};
static int32_t pyramids[][5] = {{0, 1, 2, 3, 8}};
static int32_t prisms[][6] = {{0, 1, 3, 4, 5, 7}};

static CwRegionData one_of_each(void) {
  return (CwRegionData){.points = points,
                        .point_count = 9,
                        .tetrahedra = tetrahedra,
                        .tetrahedron_count = 1,
                        .pyramids = pyramids,
                        .pyramid_count = 1,
                        .prisms = prisms,
                        .prism_count = 1};
}

static void volumes_are_those_of_the_textbook(void **state) {
  (void)state;
  CwRegionData region = one_of_each();
  assert_float_equal(cw_cell_volume(&region, 0), 1.0 / 6, 1e-15);
  assert_float_equal(cw_cell_volume(&region, 1), 1.0 / 3, 1e-15);
  assert_float_equal(cw_cell_volume(&region, 2), 1.0 / 2, 1e-15);
}

static void an_inverted_cell_has_a_negative_volume(void **state) {
  (void)state;
  int32_t inverted[][4] = {{1, 0, 3, 4}};
  CwRegionData region = one_of_each();
  region.tetrahedra = inverted;
  assert_float_equal(cw_cell_volume(&region, 0), -1.0 / 6, 1e-15);
}

// Every face looks out of its cell, and together they close.
static void faces_look_outward_and_close(void **state) {
  (void)state;
  CwRegionData region = one_of_each();
  const int faces[] = {4, 5, 5}, triangles[] = {4, 4, 2};
  for (int32_t cell = 0; cell < 3; ++cell) {
    int nodes, found_triangles = 0;
    double sum[3] = {0}, centre[3];
    cw_cell_nodes(&region, cell, &nodes);
    cw_cell_centre(&region, cell, centre);
    assert_int_equal(cw_cell_face_count(nodes), faces[cell]);
    for (int f = 0; f < faces[cell]; ++f) {
      int32_t corner[4];
      double area[3], out = 0;
      int count = cw_cell_face(&region, cell, f, corner);
      cw_face_area((const double(*)[3])points, corner, count, area);
      found_triangles += count == 3;
      for (int k = 0; k < 3; ++k) {
        sum[k] += area[k];
        out += area[k] * (points[corner[0]][k] - centre[k]);
      }
      assert_true(out > 0);
    }
    assert_int_equal(found_triangles, triangles[cell]);
    for (int k = 0; k < 3; ++k)
      assert_float_equal(sum[k], 0, 1e-15);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(volumes_are_those_of_the_textbook),
      cmocka_unit_test(an_inverted_cell_has_a_negative_volume),
      cmocka_unit_test(faces_look_outward_and_close),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
