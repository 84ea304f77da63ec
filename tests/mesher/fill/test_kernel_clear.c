// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "joined_mesh.h"
#include "mesher/fill/kernel_clear.h"
#include "mesher/fill/kernel_recover.h"

// The facets over all points are missing before, and there after the hollow was cleared.
static void clear(int32_t points, const double (*x)[3], int32_t triangles, const int32_t (*triangle)[3], int expected) {
  CwFillInput input = {
      .point_count = points, .x = x, .triangle_count = triangles, .triangle = triangle, .name = "rotor region 3"};
  CwDelaunay mesh;
  CwFacets facets;
  CwFlips flips;
  int32_t sources = points;
  int found;
  assert_int_equal(cw_delaunay_make(points, x, &mesh), CW_OK);
  assert_int_equal(cw_facets_make(&input, &mesh, &facets), CW_OK);
  assert_int_equal(cw_facets_locate(&mesh, points, &facets), CW_OK);
  assert_int_equal(facets.missing_count, triangles);
  double six = joined_volume6(&mesh);
  assert_int_equal(cw_flips_make(&mesh, &flips), CW_OK);
  assert_int_equal(cw_kernel_clear(&flips, &facets, 0, &sources, &found), CW_OK);
  assert_int_equal(found, expected);
  assert_int_equal(sources, points + (expected ? 2 : 0));
  assert_int_equal(mesh.point_count, CW_DELAUNAY_CORNERS + sources);
  assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
  assert_int_equal(cw_facets_locate(&mesh, points, &facets), CW_OK);
  assert_int_equal(facets.missing_count, expected ? 0 : triangles);
  cw_flips_free(&flips);
  cw_facets_free(&facets);
  cw_delaunay_free(&mesh);
}

// A short axis through a triangle.
static void face_of_a_bipyramid(void **unused) {
  const double x[5][3] = {{1, 0, 0}, {-0.5, 0.8, 0.01}, {-0.5, -0.8, 0}, {0.01, 0, 0.3}, {0, 0.01, -0.3}};
  const int32_t up[1][3] = {{0, 1, 2}}, down[1][3] = {{0, 2, 1}};
  clear(5, x, 1, up, 1);
  clear(5, x, 1, down, 1);
}

// Through a bent quadrilateral, whose diagonal is missing too.
static void two_faces_and_their_edge(void **unused) {
  const double x[6][3] = {{1, 0.02, 0},       {0, 0.9, 0.1},    {-1, 0, 0},
                          {0.01, -0.95, 0.1}, {0.02, 0.2, 0.3}, {0, 0.21, -0.3}};
  const int32_t triangle[2][3] = {{0, 1, 2}, {0, 2, 3}};
  clear(6, x, 2, triangle, 1);
}

// A triangle pierced by an edge of another one that is there: nothing is done.
static void facets_that_cross_stay(void **unused) {
  const double x[5][3] = {{1, 0, 0}, {-0.5, 0.8, 0.01}, {-0.5, -0.8, 0}, {0.01, 0, 0.3}, {0, 0.01, -0.3}};
  const int32_t triangle[2][3] = {{0, 1, 2}, {0, 3, 4}};
  CwFillInput input = {.point_count = 5, .x = x, .triangle_count = 2, .triangle = triangle, .name = "rotor region 3"};
  CwDelaunay mesh;
  CwFacets facets;
  int32_t sources = 5;
  assert_int_equal(cw_delaunay_make(5, x, &mesh), CW_OK);
  assert_int_equal(cw_facets_make(&input, &mesh, &facets), CW_OK);
  assert_int_equal(cw_facets_locate(&mesh, 5, &facets), CW_OK);
  assert_int_equal(facets.missing_count, 1);
  for (int round = 0; round < 4; round++) {
    assert_int_equal(cw_kernel_recover(&mesh, &facets, round, &sources, &(CwRecovered){0}), CW_OK);
    assert_int_equal(facets.missing_count, 1);
    int32_t inner[2] = {facets.inner[0], facets.inner[1]};
    assert_int_equal(cw_facets_locate(&mesh, 5, &facets), CW_OK);
    assert_memory_equal(inner, facets.inner, sizeof inner);
  }
  assert_int_equal(facets.missing_count, 1);
  assert_true(facets.inner[0] < 0 && facets.inner[1] >= 0);
  assert_int_equal(sources, 5);
  cw_facets_free(&facets);
  cw_delaunay_free(&mesh);
}

static void segments_and_triangles(void **unused) {
  const double x[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, -1}, {0.25, 0.25, 1}, {2, 2, 1}};
  const int32_t given[3] = {0, 1, 2};
  CwDelaunay mesh;
  int32_t p[6], t[3];
  assert_int_equal(cw_delaunay_make(6, x, &mesh), CW_OK);
  for (int32_t k = CW_DELAUNAY_CORNERS; k < mesh.point_count; k++) p[mesh.source[k]] = k;
  for (int k = 0; k < 3; k++) t[k] = p[given[k]];
  assert_int_equal(cw_kernel_meet(&mesh, p[3], p[4], t), 1);
  assert_int_equal(cw_kernel_meet(&mesh, p[4], p[3], t), 1);
  assert_int_equal(cw_kernel_meet(&mesh, p[4], p[5], t), 0);
  assert_int_equal(cw_kernel_meet(&mesh, p[3], p[5], t), 0);
  cw_delaunay_free(&mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(face_of_a_bipyramid),
      cmocka_unit_test(two_faces_and_their_edge),
      cmocka_unit_test(facets_that_cross_stay),
      cmocka_unit_test(segments_and_triangles),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
