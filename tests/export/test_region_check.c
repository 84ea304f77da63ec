// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/region_check.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

// Two tetrahedra on the triangle 0-1-2 of shared points: a domain of one region, with every outer face on a patch.
static double points[6][3];
static int64_t shared_id[] = {0, 1, 2};
static int32_t tetrahedra[2][4];
static int32_t triangles[][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
static int32_t triangle_patch[6], triangle_cell[] = {0, 0, 0, 1, 1, 1};
static CwMeshRegion line = {.path = "rotor-0001.h5"};
static CwMesh mesh = {.regions = &line, .region_count = 1};
static CwRegionPlace place;
static CwAssembly assembly = {.mesh = &mesh, .places = &place};
static CwRegionData data;

static int make(void **state) {
  (void)state;
  memcpy(points, (double[][3]){{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -2}, {9, 9, 9}}, sizeof points);
  memcpy(tetrahedra, (int32_t[][4]){{0, 1, 2, 3}, {0, 2, 1, 4}}, sizeof tetrahedra);
  place = (CwRegionPlace){.inner_triangles = 1};
  data = (CwRegionData){.points = points,
                        .point_count = 5,
                        .shared_count = 3,
                        .shared_id = shared_id,
                        .tetrahedra = tetrahedra,
                        .tetrahedron_count = 2,
                        .triangles = triangles,
                        .triangle_patch = triangle_patch,
                        .triangle_cell = triangle_cell,
                        .triangle_count = 6};
  return 0;
}

static void a_sound_region_gives_its_volume(void **state) {
  (void)state;
  CwRegionFaces faces = {0};
  CwRegionFigures figures;
  assert_int_equal(cw_region_check(&assembly, 0, &data, &faces, &figures), CW_OK);
  assert_float_equal(figures.volume, 1.0 / 6 + 2.0 / 6, 1e-15);
  assert_float_equal(figures.least_volume, 1.0 / 6, 1e-15);
  assert_int_equal(faces.inner_triangles, 1);
  cw_region_faces_free(&faces);
}

static void fails_with(const char *words) {
  CwRegionFaces faces = {0};
  CwRegionFigures figures;
  assert_int_equal(cw_region_check(&assembly, 0, &data, &faces, &figures), CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), words)) fail_msg("unexpected message: %s", cw_fail_message());
  cw_region_faces_free(&faces);
}

static void a_cell_turned_inside_out_is_told(void **state) {
  (void)state;
  points[3][2] = -1;
  fails_with("rotor-0001.h5: cell 0 at (250, 250, -250) mm has a volume of -1.67e+08 mm3");
  points[3][2] = 0.0 / 0.0;
  fails_with("rotor-0001.h5: cell 0 at");
}

static void a_point_without_cell_is_told(void **state) {
  (void)state;
  data.point_count = 6;
  fails_with("rotor-0001.h5: point 5 at (9000, 9000, 9000) mm is used by no cell");
}

static void a_region_that_has_changed_is_told(void **state) {
  (void)state;
  place.inner_triangles = 2;
  fails_with("rotor-0001.h5: has other faces than when it was first read");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_sound_region_gives_its_volume, make),
      cmocka_unit_test_setup(a_cell_turned_inside_out_is_told, make),
      cmocka_unit_test_setup(a_point_without_cell_is_told, make),
      cmocka_unit_test_setup(a_region_that_has_changed_is_told, make),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
