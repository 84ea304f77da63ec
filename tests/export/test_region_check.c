// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/region_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/unit_test.h"

// Two tetrahedra on the triangle 0-1-2 of shared points: a domain of one region, with every outer face on a patch.
static double points[6][3];
static int64_t shared_id[] = {0, 1, 2};
static int32_t tetrahedra[2][4];
static int32_t triangles[][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
static int32_t triangle_patch[6], triangle_cell[] = {0, 0, 0, 1, 1, 1};
static CwMeshRegion lines[3] = {{.path = "rotor-0001.h5"}, {.path = "rotor-0002.h5"}, {.path = "rotor-0003.h5"}};
static int alike[3];
static CwMesh mesh = {.regions = lines, .region_count = 1};
static CwRegionPlace place[3];
static CwAssembly assembly = {.mesh = &mesh, .places = place, .share = {.alike = alike}};
static CwRegionData data;

static int make(void **state) {
  memcpy(points, (double[][3]){{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -2}, {9, 9, 9}}, sizeof points);
  memcpy(tetrahedra, (int32_t[][4]){{0, 1, 2, 3}, {0, 2, 1, 4}}, sizeof tetrahedra);
  mesh.region_count = 1;
  for (int r = 0; r < 3; ++r) place[r] = (CwRegionPlace){.inner.triangles = 1};
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
  CwRegionModel model = {0};
  assert_int_equal(cw_region_check(&assembly, 0, &data, &model), CW_OK);
  assert_near(model.figures.volume, 1.0 / 6 + 2.0 / 6, 1e-14);
  assert_near(model.figures.least_volume, 1.0 / 6, 1e-15);
  assert_int_equal(model.faces.inner_triangles, 1);
  cw_region_model_keep(&assembly, 0, &data, &model); // no other is to come
  assert_false(model.kept);
  assert_null(model.faces.across);
}

static void fails_with(const char *words) {
  CwRegionModel model = {0};
  assert_int_equal(cw_region_check(&assembly, 0, &data, &model), CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), words)) fail_msg("unexpected message: %s", cw_fail_message());
  cw_region_model_free(&model);
}

static void a_cell_turned_inside_out_is_told(void **state) {
  points[3][2] = -1;
  fails_with("rotor-0001.h5: cell 0 at (250, 250, -250) mm has a volume of -1.67e+08 mm3");
  points[3][2] = 0.0 / 0.0;
  fails_with("rotor-0001.h5: cell 0 at");
}

static void a_point_without_cell_is_told(void **state) {
  data.point_count = 6;
  fails_with("rotor-0001.h5: point 5 at (9000, 9000, 9000) mm is used by no cell");
}

static void a_region_that_has_changed_is_told(void **state) {
  place[0].inner.triangles = 2;
  fails_with("rotor-0001.h5: has other faces than when it was first read");
}

// The region in memory of its own, turned by an angle.
static CwRegionData turned(double angle) {
  CwRegionData copy = data;
  const size_t sizes[] = {sizeof points,    sizeof shared_id,     sizeof tetrahedra,
                          sizeof triangles, sizeof triangle_cell, sizeof triangle_patch};
  const void *from[] = {points, shared_id, tetrahedra, triangles, triangle_cell, triangle_patch};
  void *to[6];
  for (int i = 0; i < 6; ++i) memcpy(to[i] = malloc(sizes[i]), from[i], sizes[i]);
  copy.points = to[0];
  copy.shared_id = to[1];
  copy.tetrahedra = to[2];
  copy.triangles = to[3];
  copy.triangle_cell = to[4];
  copy.triangle_patch = to[5];
  for (int p = 0; p < 6; ++p) {
    const double x = points[p][0], y = points[p][1];
    copy.points[p][0] = cos(angle) * x - sin(angle) * y;
    copy.points[p][1] = sin(angle) * x + cos(angle) * y;
  }
  return copy;
}

// Checks the last of three regions that are alike and then the second. Returns whether that was taken for a copy of the
// last.
static int second_is_copy(CwRegionData *second) {
  CwRegionModel model = {0};
  CwRegionData first = turned(0);
  mesh.region_count = 3;
  assert_int_equal(cw_region_check(&assembly, 2, &first, &model), CW_OK);
  cw_region_model_keep(&assembly, 2, &first, &model);
  assert_true(model.kept);
  assert_null(first.points); // taken over
  const double volume = model.figures.volume;
  assert_int_equal(cw_region_check(&assembly, 1, second, &model), CW_OK);
  const int copy = model.kept;
  assert_int_equal(model.region, copy ? 2 : 1);
  assert_true(copy ? model.figures.volume == volume : model.figures.volume != volume);
  cw_region_model_free(&model);
  cw_mesh_region_free(second);
  return copy;
}

static void a_turned_copy_has_the_faces_of_its_model(void **state) {
  for (int k = 1; k < 6; ++k) {
    CwRegionData second = turned(M_PI / 3 * k);
    assert_true(second_is_copy(&second));
  }
}

static void what_is_no_turned_copy_is_checked_itself(void **state) {
  CwRegionData moved = turned(1);
  moved.points[4][2] -= 1e-13;
  assert_false(second_is_copy(&moved));
  moved = turned(1); // wider, of the same height
  for (int p = 0; p < 6; ++p)
    for (int k = 0; k < 2; ++k) moved.points[p][k] *= 1.25;
  assert_false(second_is_copy(&moved));
  moved = turned(1); // the same cells in another order
  memcpy(moved.tetrahedra, (int32_t[][4]){{0, 2, 1, 4}, {0, 1, 2, 3}}, sizeof tetrahedra);
  for (int i = 0; i < 6; ++i) moved.triangle_cell[i] = 1 - moved.triangle_cell[i];
  moved.points[4][2] *= 2; // for another volume
  assert_false(second_is_copy(&moved));
}

static void a_copy_with_another_number_of_faces_is_told(void **state) {
  CwRegionModel model = {0};
  CwRegionData first = turned(0), second = turned(2);
  mesh.region_count = 3;
  place[1].inner.triangles = 2;
  assert_int_equal(cw_region_check(&assembly, 2, &first, &model), CW_OK);
  cw_region_model_keep(&assembly, 2, &first, &model);
  assert_int_equal(cw_region_check(&assembly, 1, &second, &model), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "rotor-0002.h5: has other faces"));
  cw_region_model_free(&model);
  cw_mesh_region_free(&second);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_sound_region_gives_its_volume, make),
      cmocka_unit_test_setup(a_cell_turned_inside_out_is_told, make),
      cmocka_unit_test_setup(a_point_without_cell_is_told, make),
      cmocka_unit_test_setup(a_region_that_has_changed_is_told, make),
      cmocka_unit_test_setup(a_turned_copy_has_the_faces_of_its_model, make),
      cmocka_unit_test_setup(what_is_no_turned_copy_is_checked_itself, make),
      cmocka_unit_test_setup(a_copy_with_another_number_of_faces_is_told, make),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
