// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// Two parts whose values begin at byte 10 of each file, or a whole mesh.
static CwFoamMesh mesh_of(int parts, int label_size) {
  CwFoamMesh mesh = {.folder = test_folder, .label_size = label_size, .division.part_count = parts};
  mesh.parts = calloc((size_t)parts, sizeof *mesh.parts);
  for (int p = 0; p < parts; ++p)
    for (int f = 0; f < CW_FOAM_FILES; ++f) mesh.parts[p].start[f] = 10 + f;
  return mesh;
}

static void folders_are_those_of_openfoam(void **state) {
  for (int parts = 1; parts <= 3; ++parts) {
    CwFoamMesh mesh = mesh_of(parts, 4);
    char *path = NULL, wanted[200];
    assert_int_equal(cw_foam_part_folder(&mesh, parts - 1, &path), CW_OK);
    if (parts == 1)
      snprintf(wanted, sizeof wanted, "%s/constant/polyMesh", test_folder);
    else
      snprintf(wanted, sizeof wanted, "%s/processor%d/constant/polyMesh", test_folder, parts - 1);
    assert_string_equal(path, wanted);
    free(path);
    free(mesh.parts);
  }
}

static char *bytes_of(const CwFoamMesh *mesh, int part, CwFoamFile f, size_t *size) {
  char *folder = NULL, path[300];
  assert_int_equal(cw_foam_part_folder(mesh, part, &folder), CW_OK);
  snprintf(path, sizeof path, "%s/%s", folder, cw_foam_file_names[f]);
  free(folder);
  return access(path, F_OK) ? NULL : read_whole(path, size);
}

// Written by two who open the files one after the other, the second values first: each stands behind those before it.
static void values_stand_behind_those_before(void **state) {
  static const int64_t labels[] = {7, -1, 2000000000, 12};
  static const double points[3][3] = {{1, 2, 3}, {4, 5, 6}, {-7, 0.125, 9}};
  static const int64_t numbers[] = {30, 40, 50};
  for (int parts = 1; parts <= 2; ++parts)
    for (int size = 4; size <= 8; size += 4) {
      CwFoamMesh mesh = mesh_of(parts, size);
      const int part = parts - 1;
      for (int turn = 0; turn < 2; ++turn) {
        CwFoamFiles files;
        const int first = turn ? 0 : 1; // how many stand before
        assert_int_equal(cw_foam_files_open(&mesh, part, turn == 0, &files), CW_OK);
        assert_int_equal(cw_foam_put_labels(&files, CW_FOAM_OWNER, labels + first, turn ? 1 : 3, first), CW_OK);
        assert_int_equal(cw_foam_put_points(&files, points + first, numbers + first, turn ? 1 : 2, first), CW_OK);
        assert_int_equal(cw_foam_files_close(&files, CW_OK), CW_OK);
      }
      size_t length;
      char *owner = bytes_of(&mesh, part, CW_FOAM_OWNER, &length);
      assert_int_equal(length, 10 + CW_FOAM_OWNER + 4 * size);
      for (int i = 0; i < 4; ++i) {
        int32_t small;
        int64_t large = 0;
        memcpy(&small, owner + 10 + CW_FOAM_OWNER + 4 * i, 4);
        if (size == 4) assert_int_equal(small, labels[i]);
        if (size == 8) memcpy(&large, owner + 10 + CW_FOAM_OWNER + 8 * i, 8);
        if (size == 8) assert_int_equal(large, labels[i]);
      }
      char *x = bytes_of(&mesh, part, CW_FOAM_POINTS, &length);
      assert_int_equal(length, 10 + CW_FOAM_POINTS + sizeof points);
      assert_memory_equal(x + 10 + CW_FOAM_POINTS, points, sizeof points);
      // What a point is called in the whole mesh is only said where that is divided.
      char *whole = bytes_of(&mesh, part, CW_FOAM_OF_POINTS, &length);
      if (parts == 1) assert_null(whole);
      if (parts == 2) assert_int_equal(length, 10 + CW_FOAM_OF_POINTS + 3 * size);
      free(owner);
      free(x);
      free(whole);
      free(mesh.parts);
    }
}

static void a_folder_that_is_missing_is_told(void **state) {
  CwFoamMesh mesh = mesh_of(2, 4);
  CwFoamFiles files;
  assert_int_equal(cw_foam_files_open(&mesh, 0, 0, &files), CW_ERR_IO); // of none that has been made
  assert_non_null(strstr(cw_fail_message(), "processor0/constant/polyMesh"));
  assert_int_equal(cw_foam_files_close(&files, CW_ERR_IO), CW_ERR_IO);
  free(mesh.parts);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(folders_are_those_of_openfoam),
      cmocka_unit_test(values_stand_behind_those_before),
      cmocka_unit_test(a_folder_that_is_missing_is_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
