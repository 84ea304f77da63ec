// SPDX-License-Identifier: AGPL-3.0-or-later
// The boundary of a region: its faces as they were, its points without those within.
#include "pipeline/report/surface.h"
#include "tests/unit_test.h"

static void points_within_are_left_out(void **state) {
  double x[][3] = {{0, 0, 0}, {1, 1, 1}, {2, 0, 0}, {3, 0, 0}, {4, 4, 4}, {5, 0, 0}, {6, 0, 0}};
  int32_t triangle[][3] = {{5, 2, 0}, {0, 2, 3}}, triangle_patch[] = {3, 1}, quad[][4] = {{6, 3, 2, 5}},
          quad_patch[] = {2};
  const CwRegionData cells = {.domain = 1,
                              .region = 9,
                              .point_count = 7,
                              .points = x,
                              .triangle_count = 2,
                              .triangles = triangle,
                              .triangle_patch = triangle_patch,
                              .quad_count = 1,
                              .quads = quad,
                              .quad_patch = quad_patch};
  CwRegionData surface = {0};
  assert_int_equal(cw_surface_of(&cells, &surface), CW_OK);
  assert_int_equal(surface.domain, 1);
  assert_int_equal(surface.region, 9);
  assert_int_equal(surface.point_count, 5);
  for (int p = 1; p < 5; p++) assert_true(surface.points[p - 1][0] < surface.points[p][0]); // in their order
  assert_int_equal(surface.triangle_count, 2);
  assert_int_equal(surface.quad_count, 1);
  for (int t = 0; t < 2; t++) {
    for (int k = 0; k < 3; k++)
      assert_memory_equal(surface.points[surface.triangles[t][k]], x[triangle[t][k]], sizeof *x);
    assert_int_equal(surface.triangle_patch[t], triangle_patch[t]);
  }
  for (int k = 0; k < 4; k++) assert_memory_equal(surface.points[surface.quads[0][k]], x[quad[0][k]], sizeof *x);
  assert_int_equal(surface.quad_patch[0], 2);
  cw_mesh_region_free(&surface);
}

static void a_region_without_faces_has_no_points(void **state) {
  double x[][3] = {{0, 0, 0}};
  const CwRegionData cells = {.point_count = 1, .points = x};
  CwRegionData surface = {0};
  assert_int_equal(cw_surface_of(&cells, &surface), CW_OK);
  assert_int_equal(surface.point_count, 0);
  cw_mesh_region_free(&surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(points_within_are_left_out),
      cmocka_unit_test(a_region_without_faces_has_no_points),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
