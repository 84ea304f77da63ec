// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/place_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/test_folder.h"
#include "tests/whole_file.h"

static void labels_stand_where_they_are_put(void **state) {
  enum { COUNT = 40000 }; // more than one piece of what is narrowed at once
  const char *path = in_test_folder("labels");
  int64_t *values = calloc(COUNT, sizeof *values);
  for (int i = 0; i < COUNT; ++i) values[i] = 3 * i - 7;
  for (int size = 4; size <= 8; size += 4) {
    CwPlaceFile file = {0};
    assert_int_equal(cw_place_file_open(test_folder, "labels", 1, &file), CW_OK);
    assert_int_equal(cw_place_file_put_labels(&file, values + 10, COUNT - 10, size, 6 + 10 * size), CW_OK);
    assert_int_equal(cw_place_file_close(&file), CW_OK);
    assert_int_equal(cw_place_file_open(test_folder, "labels", 0, &file), CW_OK); // keeps what is there
    assert_int_equal(cw_place_file_put_labels(&file, values, 10, size, 6), CW_OK);
    assert_int_equal(cw_place_file_put(&file, "labels", 6, 0), CW_OK);
    assert_int_equal(cw_place_file_close(&file), CW_OK);
    FILE *in = fopen(path, "rb");
    char head[6];
    assert_int_equal(fread(head, 1, 6, in), 6);
    assert_memory_equal(head, "labels", 6);
    for (int i = 0; i < COUNT; ++i) {
      int64_t wide = 0;
      int32_t narrow = 0;
      assert_int_equal(size == 8 ? fread(&wide, 8, 1, in) : fread(&narrow, 4, 1, in), 1);
      assert_int_equal(size == 8 ? wide : narrow, values[i]);
    }
    assert_int_equal(fgetc(in), EOF);
    fclose(in);
  }
  remove(path);
  free(values);
}

static void a_folder_that_is_missing_is_told(void **state) {
  CwPlaceFile file = {0};
  assert_int_equal(cw_place_file_open("/nowhere", "labels", 1, &file), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "/nowhere/labels: cannot be written: No such file"));
  assert_int_equal(cw_place_file_close(&file), CW_OK);
}

// As in a process that was started with its standard input closed.
static void a_file_may_have_the_first_descriptor(void **state) {
  const char *path = in_test_folder("labels");
  CwPlaceFile file = {0};
  const int kept = dup(STDIN_FILENO);
  close(STDIN_FILENO);
  const CwStatus opened = cw_place_file_open(test_folder, "labels", 1, &file);
  const CwStatus put = opened == CW_OK ? cw_place_file_put(&file, "labels", 6, 0) : opened;
  const CwStatus closed = cw_place_file_close(&file);
  if (kept >= 0) {
    assert_int_equal(dup2(kept, STDIN_FILENO), STDIN_FILENO);
    close(kept);
  }
  assert_int_equal(opened, CW_OK);
  assert_int_equal(put, CW_OK);
  assert_int_equal(closed, CW_OK);
  char *text = read_whole(path, NULL);
  assert_string_equal(text, "labels");
  free(text);
  remove(path);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(labels_stand_where_they_are_put),
      cmocka_unit_test(a_folder_that_is_missing_is_told),
      cmocka_unit_test(a_file_may_have_the_first_descriptor),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
