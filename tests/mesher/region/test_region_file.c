// SPDX-License-Identifier: AGPL-3.0-or-later
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <hdf5.h>

#include "mesher/common/model_unit.h"
#include "mesher/region/region_file.h"
#include "tests/refused_write.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static const char *path, *other;

static int make_folder(void **state) {
  if (make_test_folder(state)) return 1;
  path = in_test_folder("rotor-0001.h5"), other = in_test_folder("rotor-0002.h5");
  return 0;
}

static int remove_files(void **state) {
  unlink(path);
  unlink(other);
  return remove_test_folder(state);
}

static double points[7][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.2, 0.2, 2}};
static int64_t ids[2] = {7, 5000000000};
static int32_t tetrahedra[1][4] = {{3, 4, 5, 6}}, prisms[1][6] = {{0, 1, 2, 3, 4, 5}};
static int32_t triangles[2][3] = {{0, 2, 1}, {3, 4, 6}}, triangle_patch[2] = {0, 3}, triangle_cell[2] = {1, 0};
static int32_t quads[1][4] = {{0, 1, 4, 3}}, quad_patch[1] = {2}, quad_cell[1] = {1};

static CwRegionMesh region_by_hand(void) {
  CwRegionMesh r = {.domain = "rotor", .region = 1, .number = 4, .fingerprint = "0123456789abcdef0123456789abcdef"};
  r.cells.point_count = 7, r.cells.shared_count = 2, r.cells.points = points, r.cells.shared_id = ids;
  r.cells.tetrahedron_count = 1, r.cells.tetrahedra = tetrahedra;
  r.cells.prism_count = 1, r.cells.prisms = prisms;
  r.cells.triangle_count = 2, r.cells.triangles = triangles, r.cells.triangle_patch = triangle_patch,
  r.cells.triangle_cell = triangle_cell;
  r.cells.quad_count = 1, r.cells.quads = quads, r.cells.quad_patch = quad_patch, r.cells.quad_cell = quad_cell;
  return r;
}

static void comes_back_as_it_was(void **state) {
  CwRegionMesh r = region_by_hand(), got;
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  assert_int_equal(cw_region_read(path, &got), CW_OK);
  assert_string_equal(got.domain, "rotor");
  assert_string_equal(got.fingerprint, r.fingerprint);
  assert_int_equal(got.region, 1);
  assert_int_equal(got.number, 4);
  assert_int_equal(got.cells.point_count, 7);
  assert_int_equal(got.cells.shared_count, 2);
  assert_int_equal(got.cells.pyramid_count, 0);
  assert_memory_equal(got.cells.points, points, sizeof points);
  assert_memory_equal(got.cells.shared_id, ids, sizeof ids);
  assert_memory_equal(got.cells.tetrahedra, tetrahedra, sizeof tetrahedra);
  assert_memory_equal(got.cells.prisms, prisms, sizeof prisms);
  assert_memory_equal(got.cells.triangles, triangles, sizeof triangles);
  assert_memory_equal(got.cells.triangle_patch, triangle_patch, sizeof triangle_patch);
  assert_memory_equal(got.cells.triangle_cell, triangle_cell, sizeof triangle_cell);
  assert_memory_equal(got.cells.quads, quads, sizeof quads);
  assert_memory_equal(got.cells.quad_patch, quad_patch, sizeof quad_patch);
  assert_memory_equal(got.cells.quad_cell, quad_cell, sizeof quad_cell);
  cw_region_free(&got);
}

// Whatever the unit, what is read has the bits of what was written; in another unit it is as long.
static void file_keeps_the_unit(void **state) {
  CwRegionMesh r = region_by_hand(), got;
  cw_model_unit_set(0.3);
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  assert_int_equal(cw_region_read(path, &got), CW_OK);
  assert_memory_equal(got.cells.points, points, sizeof points);
  cw_region_free(&got);
  cw_model_unit_set(1);
  assert_int_equal(cw_region_read(path, &got), CW_OK);
  for (int p = 0; p < 7; p++) {
    for (int k = 0; k < 3; k++) assert_true(got.cells.points[p][k] == 0.3 * points[p][k]);
  }
  cw_region_free(&got);
}

static void equal_regions_give_equal_bytes(void **state) {
  CwRegionMesh r = region_by_hand();
  size_t size, size_b;
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  sleep(1); // a time stamp would differ
  assert_int_equal(cw_region_write(other, &r), CW_OK);
  char *a = read_whole(path, &size), *b = read_whole(other, &size_b);
  assert_int_equal(size_b, size);
  assert_memory_equal(a, b, size);
  free(a);
  free(b);
}

static CwRegionFound take_up(const char *fingerprint, CwRegionMesh *got) {
  CwRegionFound found;
  assert_int_equal(cw_region_take_up(path, fingerprint, got, &found), CW_OK);
  return found;
}

static void taken_up_only_with_the_fingerprint_and_whole(void **state) {
  CwRegionMesh r = region_by_hand(), got;
  char digest[CW_HASH_TEXT];
  unlink(path);
  assert_int_equal(take_up(r.fingerprint, &got), CW_REGION_OTHER);
  assert_int_equal(cw_region_digest_read(path, digest), CW_ERR_IO);
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  assert_int_equal(take_up(r.fingerprint, &got), CW_REGION_TAKEN);
  assert_memory_equal(got.cells.points, points, sizeof points);
  assert_string_equal(got.digest, r.digest);
  cw_region_free(&got);
  assert_int_equal(cw_region_digest_read(path, digest), CW_OK);
  assert_string_equal(digest, r.digest);
  assert_int_equal(take_up("0123456789abcdef0123456789abcdee", &got), CW_REGION_OTHER);
  size_t size;
  char *bytes = read_whole(path, &size);
  assert_int_equal(truncate(path, (off_t)size - 8), 0);
  assert_int_equal(take_up(r.fingerprint, &got), CW_REGION_DAMAGED);
  assert_non_null(strstr(cw_fail_message(), path));
  assert_int_equal(cw_region_read(path, &got), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), path));
  free(bytes);
}

// Every bit of the file counts, whether it belongs to an array, an attribute, or HDF5 itself.
static void no_bit_may_change(void **state) {
  CwRegionMesh r = region_by_hand(), got;
  size_t size;
  int taken = 0;
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  char *bytes = read_whole(path, &size);
  for (size_t i = 0; i < size; i++) {
    const char kept = bytes[i];
    bytes[i] ^= (char)(1 << i % 8);
    write_whole(path, bytes, size);
    if (take_up(r.fingerprint, &got) == CW_REGION_TAKEN) {
      print_message("byte %zu of %zu\n", i, size);
      taken++;
      cw_region_free(&got);
    }
    bytes[i] = kept;
  }
  assert_int_equal(taken, 0);
  write_whole(path, bytes, size + 1); // whatever lay behind them
  assert_int_equal(take_up(r.fingerprint, &got), CW_REGION_DAMAGED);
  assert_non_null(strstr(cw_fail_message(), "has bytes after its end"));
  free(bytes);
}

// Two files that are whole, but stand in each other's place, are told apart by their digests.
static void regions_have_digests_of_their_own(void **state) {
  CwRegionMesh r = region_by_hand();
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  char first[CW_HASH_TEXT];
  strcpy(first, r.digest);
  points[6][2] = nextafter(2, 3);
  assert_int_equal(cw_region_write(other, &r), CW_OK);
  points[6][2] = 2;
  assert_string_not_equal(r.digest, first);
  r.number++;
  assert_int_equal(cw_region_write(other, &r), CW_OK);
  assert_string_not_equal(r.digest, first);
}

static void wrong_index_is_named(void **state) {
  CwRegionMesh r = region_by_hand(), got;
  tetrahedra[0][2] = 7;
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  tetrahedra[0][2] = 5;
  assert_int_equal(cw_region_read(path, &got), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "dataset 'tetrahedra': entry 2 is 7; allowed 0 to 6"));
  quad_cell[0] = 2;
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  quad_cell[0] = 1;
  assert_int_equal(cw_region_read(path, &got), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "dataset 'quad_cell': entry 0 is 2; allowed 0 to 1"));
  points[3][1] = NAN;
  assert_int_equal(cw_region_write(path, &r), CW_OK);
  points[3][1] = 0;
  assert_int_equal(cw_region_read(path, &got), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "point 3 has a coordinate"));
}

static void folder_that_is_not_there_is_an_io_error(void **state) {
  CwRegionMesh r = region_by_hand();
  const char *nowhere = in_test_folder("none/rotor-0001.h5");
  assert_int_equal(cw_region_write(nowhere, &r), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), strerror(ENOENT)));
  assert_non_null(strstr(cw_fail_message(), nowhere));
}

// Whichever write it was, even if all later ones succeed: no file bears the name that lacks something.
static void no_write_is_lost_unseen(void **state) {
  CwRegionMesh r = region_by_hand();
  unlink(path);
  for (refused_write = 1;; refused_write++) {
    writes = 0;
    CwStatus status = cw_region_write(path, &r);
    if (writes < refused_write) {
      assert_int_equal(status, CW_OK);
      break;
    }
    if (status != CW_ERR_IO) fail_msg("write %d of %d was lost unseen", refused_write, writes);
    assert_int_equal(access(path, F_OK), -1);
  }
  assert_true(refused_write > 10);
  refused_write = 0;
}

int main(void) {
  H5dont_atexit(); // HDF5 stumbles there over files that could not be closed
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(comes_back_as_it_was),
      cmocka_unit_test(file_keeps_the_unit),
      cmocka_unit_test(equal_regions_give_equal_bytes),
      cmocka_unit_test(taken_up_only_with_the_fingerprint_and_whole),
      cmocka_unit_test(no_bit_may_change),
      cmocka_unit_test(regions_have_digests_of_their_own),
      cmocka_unit_test(wrong_index_is_named),
      cmocka_unit_test(folder_that_is_not_there_is_an_io_error),
      cmocka_unit_test(no_write_is_lost_unseen),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_files);
}
