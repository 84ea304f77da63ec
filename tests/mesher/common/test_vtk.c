// SPDX-License-Identifier: AGPL-3.0-or-later
// What is written is read back: every number of points, triangles, lines and fields, to the last bit.
#include <stdio.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vtk.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static const char *path(void) {
  return in_test_folder("vtk-test.vtk");
}

static const double X[4][3] = {{0.1, 0, 1e-9}, {1, 2.0 / 3, 0}, {-3, 0, 5}, {0, 1, 7e5}};
static const int32_t WHOLE[2] = {-4, 2000000000};
static const double REAL[2] = {1.0 / 3, -1e-300};

// Opens the file behind its third line, and reads the points, of twice the coordinates.
static FILE *open_points(const char *title) {
  FILE *file = fopen(path(), "r");
  char line[100];
  int count = 0;
  assert_non_null(file);
  assert_non_null(fgets(line, sizeof line, file));
  assert_string_equal(line, "# vtk DataFile Version 3.0\n");
  assert_non_null(fgets(line, sizeof line, file));
  assert_string_equal(line, title);
  assert_int_equal(fscanf(file, "ASCII\nDATASET POLYDATA\nPOINTS %d double", &count), 1);
  assert_int_equal(count, 4);
  for (int p = 0; p < 4; p++) {
    for (int k = 0; k < 3; k++) {
      double value;
      assert_int_equal(fscanf(file, "%lf", &value), 1);
      assert_true(value == 2 * X[p][k]);
    }
  }
  return file;
}

static void expect_words(FILE *file, int count, const char *const *words) {
  char word[40];
  for (int i = 0; i < count; i++) {
    assert_int_equal(fscanf(file, "%39s", word), 1);
    assert_string_equal(word, words[i]);
  }
}

static void expect_fields(FILE *file) {
  double real;
  int whole, count;
  assert_int_equal(fscanf(file, " CELL_DATA %d SCALARS whole int 1 LOOKUP_TABLE default", &count), 1);
  assert_int_equal(count, 2);
  for (int i = 0; i < 2; i++) {
    assert_int_equal(fscanf(file, "%d", &whole), 1);
    assert_int_equal(whole, WHOLE[i]);
  }
  const char *const head[] = {"SCALARS", "real", "double", "1", "LOOKUP_TABLE", "default"};
  expect_words(file, 6, head);
  for (int i = 0; i < 2; i++) {
    assert_int_equal(fscanf(file, "%lf", &real), 1);
    assert_true(real == REAL[i]);
  }
  assert_int_equal(fscanf(file, "%d", &whole), EOF);
}

static const CwVtkField FIELD[2] = {{"whole", WHOLE, NULL}, {"real", NULL, REAL}};

static void triangles_are_read_back(void **state) {
  const int32_t triangle[2][3] = {{0, 1, 2}, {3, 2, 1}};
  const CwVtkTriangles triangles = {"two triangles", 4, X, 2, triangle, 2, FIELD};
  assert_int_equal(cw_vtk_write(path(), &triangles), CW_OK);
  FILE *file = open_points("two triangles, m\n");
  const char *const words[] = {"POLYGONS", "2", "8", "3", "0", "1", "2", "3", "3", "2", "1"};
  expect_words(file, 11, words);
  expect_fields(file);
  fclose(file);
  remove(path());
}

static void lines_are_read_back(void **state) {
  const int32_t start[3] = {0, 1, 4};
  const CwVtkLines lines = {"two lines", X, 2, start, 2, FIELD};
  assert_int_equal(cw_vtk_write_lines(path(), &lines), CW_OK);
  FILE *file = open_points("two lines, m\n");
  const char *const words[] = {"LINES", "2", "6", "1", "0", "3", "1", "2", "3"};
  expect_words(file, 9, words);
  expect_fields(file);
  fclose(file);
  remove(path());
}

static void no_folder_is_told(void **state) {
  const CwVtkTriangles none = {.title = "none"};
  assert_int_equal(cw_vtk_write("no-folder/of-this-name.vtk", &none), CW_ERR_IO);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(triangles_are_read_back),
      cmocka_unit_test(lines_are_read_back),
      cmocka_unit_test(no_folder_is_told),
  };
  cw_model_unit_set(2);
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
