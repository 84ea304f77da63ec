// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/region_items.h"

#include <string.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"

static const char *path;
static double points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static int64_t shared_id[1] = {8};
static int32_t tetrahedra[1][4] = {{0, 1, 2, 3}}, triangles[1][3] = {{0, 2, 1}}, triangle_patch[1] = {2}, zero[1];
static const CwRegionData region = {.point_count = 4,
                                    .shared_count = 1,
                                    .tetrahedron_count = 1,
                                    .triangle_count = 1,
                                    .points = points,
                                    .shared_id = shared_id,
                                    .tetrahedra = tetrahedra,
                                    .triangles = triangles,
                                    .triangle_patch = triangle_patch,
                                    .triangle_cell = zero};

static void write_file(int format) {
  char digest[CW_HASH_TEXT];
  hid_t file = cw_region_items_create(path);
  assert_true(file >= 0);
  assert_int_equal(cw_region_items_put_integer(file, "format", format), CW_OK);
  assert_int_equal(cw_region_items_put_text(file, "domain", "rotor"), CW_OK);
  assert_int_equal(cw_region_items_write(file, &region, digest), CW_OK);
  H5Fclose(file);
}

static int make_file(void **state) {
  const int failed = make_test_folder(state);
  path = in_test_folder("region.h5");
  return failed;
}

static int remove_file(void **state) {
  return unlink(path) || remove_test_folder(state);
}

static void the_surface_comes_without_the_cells(void **state) {
  CwRegionData data = {.point_count = -1, .triangle_count = -1, .quad_count = -1};
  hid_t file = -1;
  write_file(CW_REGION_FORMAT);
  assert_int_equal(cw_region_items_open(path, &file, NULL), CW_OK);
  assert_int_equal(cw_region_items_read(file, path, CW_REGION_SURFACE, &data), CW_OK);
  assert_int_equal(data.point_count, 4);
  assert_int_equal(data.triangle_count, 1);
  assert_int_equal(data.quad_count, 0);
  assert_memory_equal(data.points, points, sizeof points);
  assert_memory_equal(data.triangles, triangles, sizeof triangles);
  assert_null(data.tetrahedra);
  assert_null(data.triangle_cell);
  assert_int_equal(cw_region_items_check(path, CW_REGION_SURFACE, 3, 0, &data), CW_OK);
  assert_int_equal(cw_region_items_check(path, CW_REGION_SURFACE, 2, 0, &data), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "dataset 'triangle_patch': entry 0 is 2; allowed 0 to 1"));
  cw_mesh_region_free(&data);
  H5Fclose(file);
}

static void counts_that_are_asked_must_be_met(void **state) {
  CwRegionData data = {.point_count = 4, .shared_count = 1, .tetrahedron_count = 2};
  hid_t file = -1;
  write_file(CW_REGION_FORMAT);
  assert_int_equal(cw_region_items_open(path, &file, NULL), CW_OK);
  assert_int_equal(cw_region_items_read(file, path, CW_REGION_WHOLE, &data), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "dataset 'tetrahedra' has 1 rows; it must have 2"));
  cw_mesh_region_free(&data);
  H5Fclose(file);
}

static void shared_numbers_have_a_limit(void **state) {
  assert_int_equal(cw_region_items_check(path, CW_REGION_WHOLE, 3, 9, &region), CW_OK);
  assert_int_equal(cw_region_items_check(path, CW_REGION_WHOLE, 3, 8, &region), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "dataset 'shared_id': entry 0 is 8; allowed 0 to 7"));
}

static void attributes_are_read_and_named(void **state) {
  hid_t file = -1;
  int32_t value;
  char text[6];
  write_file(CW_REGION_FORMAT);
  assert_int_equal(cw_region_items_open(path, &file, NULL), CW_OK);
  assert_int_equal(cw_region_items_text(file, path, "domain", text, 6), CW_OK);
  assert_string_equal(text, "rotor");
  assert_int_equal(cw_region_items_text(file, path, "domain", text, 5), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "attribute 'domain' has 5 characters; at most 4 are allowed"));
  assert_int_equal(cw_region_items_text(file, path, "format", text, 6), CW_ERR_INPUT);
  assert_int_equal(cw_region_items_integer(file, path, "number", &value), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "attribute 'number' is missing"));
  H5Fclose(file);
}

static void files_that_are_none_are_told(void **state) {
  hid_t file = -1;
  write_file(7);
  assert_int_equal(cw_region_items_open(path, &file, NULL), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "attribute 'format' is 7; it must be 4"));
  assert_int_equal(truncate(path, 100), 0);
  assert_int_equal(cw_region_items_open(path, &file, NULL), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "is missing, damaged or cut short"));
}

// A value of an array or of an attribute that HDF5 itself takes for good.
static void what_was_not_written_so_is_told(void **state) {
  const int32_t other = 3;
  int32_t value = 1;
  CwRegionData data = {.point_count = 4, .shared_count = 1, .tetrahedron_count = 1, .triangle_count = 1};
  hid_t file = -1;
  write_file(CW_REGION_FORMAT);
  hid_t changed = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT), set = H5Dopen2(changed, "triangle_patch", H5P_DEFAULT);
  assert_true(H5Dwrite(set, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, &other) >= 0);
  H5Dclose(set);
  H5Fclose(changed);
  assert_int_equal(cw_region_items_open(path, &file, NULL), CW_OK);
  assert_int_equal(cw_region_items_read(file, path, CW_REGION_WHOLE, &data), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "dataset 'triangle_patch': not as it was written; the file is damaged"));
  cw_mesh_region_free(&data);
  H5Fclose(file);
  write_file(CW_REGION_FORMAT);
  changed = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
  assert_int_equal(cw_region_items_put_integer(changed, "number", value), CW_OK);
  H5Fclose(changed);
  assert_int_equal(cw_region_items_open(path, &file, NULL), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "attributes: not as they were written; the file is damaged"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_surface_comes_without_the_cells), cmocka_unit_test(counts_that_are_asked_must_be_met),
      cmocka_unit_test(shared_numbers_have_a_limit),         cmocka_unit_test(attributes_are_read_and_named),
      cmocka_unit_test(files_that_are_none_are_told),        cmocka_unit_test(what_was_not_written_so_is_told),
  };
  return cmocka_run_group_tests(tests, make_file, remove_file);
}
