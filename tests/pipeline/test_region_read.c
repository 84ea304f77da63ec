// SPDX-License-Identifier: AGPL-3.0-or-later
// The file of one region with a cell of each kind, held against its line of a manifest.
#include "pipeline/mesh/region_read.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"

static double points[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
static int64_t shared_id[2] = {8, 3};
static int32_t tetrahedra[1][4] = {{0, 1, 2, 3}}, pyramids[1][5] = {{0, 1, 4, 3, 2}},
               prisms[1][6] = {{0, 1, 2, 3, 4, 5}}, triangles[2][3] = {{0, 2, 1}, {3, 4, 5}},
               triangle_patch[2] = {1, 0}, triangle_cell[2] = {0, 2}, quads[1][4] = {{0, 1, 4, 3}}, quad_patch[1] = {1},
               quad_cell[1] = {1};
static const CwRegionData region = {.point_count = 6,
                                    .shared_count = 2,
                                    .tetrahedron_count = 1,
                                    .pyramid_count = 1,
                                    .prism_count = 1,
                                    .triangle_count = 2,
                                    .quad_count = 1,
                                    .points = points,
                                    .shared_id = shared_id,
                                    .tetrahedra = tetrahedra,
                                    .pyramids = pyramids,
                                    .prisms = prisms,
                                    .triangles = triangles,
                                    .triangle_patch = triangle_patch,
                                    .triangle_cell = triangle_cell,
                                    .quads = quads,
                                    .quad_patch = quad_patch,
                                    .quad_cell = quad_cell};

static char path[200];
static CwMeshRegion lines[3];
static CwMesh mesh;

// The file of region 7 of the rotor, in a unit of 1/4 m (unless 0), and the line of the manifest that it fits: the last
// of three, in the second of two domains.
static void make(double unit) {
  memset(lines, 0, sizeof lines);
  hid_t file = cw_region_items_create(path);
  assert_true(file >= 0);
  assert_int_equal(cw_region_items_put_integer(file, "format", CW_REGION_FORMAT), CW_OK);
  assert_int_equal(cw_region_items_put_text(file, "domain", "rotor"), CW_OK);
  assert_int_equal(cw_region_items_put_integer(file, "region", 7), CW_OK);
  if (unit != 0) assert_int_equal(cw_region_items_put_number(file, "unit_m", unit), CW_OK);
  assert_int_equal(cw_region_items_write(file, &region, lines[2].digest), CW_OK);
  H5Fclose(file);
  lines[2].path = path;
  lines[2].domain = 1;
  lines[2].region = 7;
  lines[2].points = 6;
  lines[2].own_points = 4;
  lines[2].tetrahedra = lines[2].pyramids = lines[2].prisms = lines[2].quads = 1;
  lines[2].triangles = 2;
  mesh = (CwMesh){.domain_count = 2,
                  .domains = {{.name = "stator", .shared_points = 1, .patch_count = 1},
                              {.name = "rotor", .shared_points = 9, .patch_count = 2}},
                  .region_count = 3,
                  .regions = lines};
}

static int make_file(void **state) {
  const int failed = make_test_folder(state);
  snprintf(path, sizeof path, "%s", in_test_folder("region.h5"));
  return failed;
}

static int remove_file(void **state) {
  return unlink(path) || remove_test_folder(state);
}

static void the_whole_region_comes_in_metres(void **state) {
  CwRegionData data = {0};
  make(0.25);
  assert_int_equal(cw_mesh_region_read(&mesh, 2, CW_REGION_WHOLE, &data), CW_OK);
  assert_int_equal(data.domain, 1);
  assert_int_equal(data.region, 7);
  assert_int_equal(data.point_count, 6);
  assert_int_equal(data.shared_count, 2);
  assert_int_equal(cw_region_cell_count(&data), 3);
  assert_int_equal(data.triangle_count, 2);
  assert_int_equal(data.quad_count, 1);
  for (int k = 0; k < 18; k++) assert_near(data.points[k / 3][k % 3], 0.25 * points[k / 3][k % 3], 0);
  assert_memory_equal(data.shared_id, shared_id, sizeof shared_id);
  assert_memory_equal(data.tetrahedra, tetrahedra, sizeof tetrahedra);
  assert_memory_equal(data.pyramids, pyramids, sizeof pyramids);
  assert_memory_equal(data.prisms, prisms, sizeof prisms);
  assert_memory_equal(data.triangles, triangles, sizeof triangles);
  assert_memory_equal(data.triangle_patch, triangle_patch, sizeof triangle_patch);
  assert_memory_equal(data.triangle_cell, triangle_cell, sizeof triangle_cell);
  assert_memory_equal(data.quads, quads, sizeof quads);
  assert_memory_equal(data.quad_patch, quad_patch, sizeof quad_patch);
  assert_memory_equal(data.quad_cell, quad_cell, sizeof quad_cell);
  cw_mesh_region_free(&data);
}

// Of the surface neither cells nor shared points are read, so that their counts are not held against anything.
static void the_surface_comes_alone(void **state) {
  CwRegionData data = {0};
  make(0.25);
  lines[2].tetrahedra = 5;
  lines[2].own_points = 6;
  assert_int_equal(cw_mesh_region_read(&mesh, 2, CW_REGION_SURFACE, &data), CW_OK);
  assert_int_equal(cw_region_cell_count(&data) + data.shared_count, 0);
  assert_null(data.tetrahedra);
  assert_null(data.shared_id);
  for (int k = 0; k < 18; k++) assert_near(data.points[k / 3][k % 3], 0.25 * points[k / 3][k % 3], 0);
  assert_memory_equal(data.triangles, triangles, sizeof triangles);
  assert_memory_equal(data.quad_patch, quad_patch, sizeof quad_patch);
  cw_mesh_region_free(&data);
}

static void told(CwRegionPart part, CwStatus wanted, const char *message) {
  CwRegionData data = {0};
  assert_int_equal(cw_mesh_region_read(&mesh, 2, part, &data), wanted);
  if (!strstr(cw_fail_message(), message)) fail_msg("%s", cw_fail_message());
  assert_non_null(strstr(cw_fail_message(), "region.h5"));
  cw_fail_clear();
  cw_mesh_region_free(&data);
  make(0.25);
}

static void another_file_than_that_of_the_line_is_told(void **state) {
  make(0.25);
  lines[2].region = 8;
  told(CW_REGION_SURFACE, CW_ERR_INPUT, "attribute 'region' is 7; it must be 8");
  lines[2].domain = 0;
  told(CW_REGION_SURFACE, CW_ERR_INPUT, "attribute 'domain' is 'rotor'; it must be 'stator'");
  lines[2].digest[5] ^= 1;
  told(CW_REGION_SURFACE, CW_ERR_INPUT, "is not the file that the manifest tells of; run cutwater-mesh again");
  make(0);
  told(CW_REGION_SURFACE, CW_ERR_INPUT, "attribute 'unit_m' is missing");
}

static void other_counts_than_those_of_the_line_are_told(void **state) {
  make(0.25);
  lines[2].points = lines[2].own_points = 5;
  told(CW_REGION_SURFACE, CW_ERR_INPUT, "dataset 'points' has 6 rows; it must have 5");
  lines[2].triangles = 3;
  told(CW_REGION_SURFACE, CW_ERR_INPUT, "dataset 'triangles' has 2 rows; it must have 3");
  lines[2].quads = 0;
  told(CW_REGION_SURFACE, CW_ERR_INPUT, "dataset 'quads' has 1 rows; it must have 0");
  lines[2].own_points = 5;
  told(CW_REGION_WHOLE, CW_ERR_INPUT, "dataset 'shared_id' has 2 rows; it must have 1");
  lines[2].tetrahedra = 2;
  told(CW_REGION_WHOLE, CW_ERR_INPUT, "dataset 'tetrahedra' has 1 rows; it must have 2");
  lines[2].pyramids = 2;
  told(CW_REGION_WHOLE, CW_ERR_INPUT, "dataset 'pyramids' has 1 rows; it must have 2");
  lines[2].prisms = 0;
  told(CW_REGION_WHOLE, CW_ERR_INPUT, "dataset 'prisms' has 1 rows; it must have 0");
}

// Limits are those of the region's own domain.
static void indices_out_of_range_are_told(void **state) {
  make(0.25);
  mesh.domains[1].patch_count = 1;
  told(CW_REGION_SURFACE, CW_ERR_INPUT, "dataset 'triangle_patch': entry 0 is 1; allowed 0 to 0");
  mesh.domains[1].shared_points = 8;
  told(CW_REGION_WHOLE, CW_ERR_INPUT, "dataset 'shared_id': entry 0 is 8; allowed 0 to 7");
}

// The lowest file descriptor that is free.
static int next_handle(void) {
  const int handle = open("/dev/null", O_RDONLY);
  assert_true(handle >= 0);
  close(handle);
  return handle;
}

static void no_file_stays_open(void **state) {
  CwRegionData data = {0};
  const int next = next_handle();
  make(0.25);
  for (int round = 0; round < 2; round++) {
    cw_mesh_region_ahead(&mesh, 2);
    assert_int_equal(cw_mesh_region_read(&mesh, 2, CW_REGION_WHOLE, &data), round ? CW_ERR_INPUT : CW_OK);
    cw_mesh_region_free(&data);
    assert_int_equal(next_handle(), next);
    assert_int_equal(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0);
    lines[2].region = 6;
  }
  cw_fail_clear();
}

// It is who reads the file that tells.
static void a_missing_file_is_told_when_it_is_read(void **state) {
  make(0.25);
  unlink(path);
  cw_mesh_region_ahead(&mesh, 2);
  assert_string_equal(cw_fail_message(), "");
  told(CW_REGION_SURFACE, CW_ERR_IO, "is missing, damaged or cut short");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_whole_region_comes_in_metres),
      cmocka_unit_test(the_surface_comes_alone),
      cmocka_unit_test(another_file_than_that_of_the_line_is_told),
      cmocka_unit_test(other_counts_than_those_of_the_line_are_told),
      cmocka_unit_test(indices_out_of_range_are_told),
      cmocka_unit_test(no_file_stays_open),
      cmocka_unit_test(a_missing_file_is_told_when_it_is_read),
  };
  return cmocka_run_group_tests(tests, make_file, remove_file);
}
