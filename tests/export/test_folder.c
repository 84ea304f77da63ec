// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/folder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "tests/test_folder.h"
#include "tests/whole_file.h"

static void make(const char *name, const char *text) {
  char file[200];
  assert_int_equal(mkdir(in_test_folder(name), 0777), 0);
  snprintf(file, sizeof file, "%s/file", name);
  write_text(in_test_folder(file), text);
}

static void holds(const char *file, const char *text) {
  char *found = read_whole(in_test_folder(file), NULL);
  assert_string_equal(found, text);
  free(found);
}

static CwStatus replace(const char *from, const char *to) {
  char place[200];
  strcpy(place, in_test_folder(from));
  return cw_folder_replace(place, in_test_folder(to));
}

static int there(const char *name) {
  return access(in_test_folder(name), F_OK) == 0;
}

// Whatever was in its place before, an earlier folder moved aside too, is gone.
static void a_folder_takes_the_place_of_another(void **state) {
  make("new", "first");
  assert_int_equal(replace("new", "made"), CW_OK);
  holds("made/file", "first");
  make("new", "second");
  make("made.old", "of a run that was killed");
  assert_int_equal(replace("new", "made"), CW_OK);
  holds("made/file", "second");
  assert_false(there("new") || there("made.old"));
  assert_int_equal(cw_folder_remove(in_test_folder("made")), CW_OK);
  assert_int_equal(cw_folder_remove(in_test_folder("made")), CW_OK);
}

static void the_old_one_is_put_back_where_the_new_one_fails(void **state) {
  char wanted[600];
  make("made", "old");
  assert_int_equal(replace("missing", "made"), CW_ERR_IO);
  snprintf(wanted, sizeof wanted, "%s/missing: cannot be renamed to %s/made: No such file or directory", test_folder,
           test_folder);
  assert_string_equal(cw_fail_message(), wanted);
  holds("made/file", "old");
  assert_false(there("made.old"));
  assert_int_equal(cw_folder_remove(in_test_folder("made")), CW_OK);
  // Nor does one appear where none was.
  assert_int_equal(replace("missing", "made"), CW_ERR_IO);
  assert_string_equal(cw_fail_message(), wanted);
  assert_false(there("made") || there("made.old"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_folder_takes_the_place_of_another),
      cmocka_unit_test(the_old_one_is_put_back_where_the_new_one_fails),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
