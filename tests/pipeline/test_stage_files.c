// SPDX-License-Identifier: AGPL-3.0-or-later
// Files, records and digests of a run of three stages, each damaged in turn.
#include "pipeline/stage_files.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "pipeline/record.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// A stage that has written one file, from those of other stages.
static void write_stage(const char *stage, const char *const *reads, const char *text) {
  CwRecord *record;
  char name[40];
  const char *folder = in_test_folder(stage);
  snprintf(name, sizeof name, "%s/made.txt", stage);
  assert_int_equal(cw_make_directory(folder), CW_OK);
  write_text(in_test_folder(name), text);
  assert_int_equal(cw_record_start(stage, NULL, &record), CW_OK);
  assert_int_equal(cw_record_made_from(record, test_folder, reads), CW_OK);
  assert_int_equal(cw_record_file(record, folder, "made.txt"), CW_OK);
  snprintf(name, sizeof name, "%s/record.json", stage);
  assert_int_equal(cw_record_write(record, in_test_folder(name)), CW_OK);
  cw_record_free(record);
}

static int make_run(void **state) {
  if (make_test_folder(state)) return -1;
  write_stage("geometry", (const char *const[]){NULL}, "a solid\n");
  write_stage("mesh", (const char *const[]){"geometry", NULL}, "a mesh\n");
  write_stage("export", (const char *const[]){"geometry", "mesh", NULL}, "a case\n");
  return 0;
}

static void refuses(const char *stage, CwStatus code, const char *words) {
  assert_int_equal(cw_stage_files_check(test_folder, stage), code);
  if (!strstr(cw_fail_message(), words)) fail_msg("%s", cw_fail_message());
}

static void all_as_written_is_taken(void **state) {
  assert_int_equal(cw_stage_files_check(test_folder, "geometry"), CW_OK);
  assert_int_equal(cw_stage_files_check(test_folder, "mesh"), CW_OK);
  assert_int_equal(cw_stage_files_check(test_folder, "export"), CW_OK);
}

static void a_changed_file_is_told_by_its_name(void **state) {
  write_text(in_test_folder("geometry/made.txt"), "a solit\n");
  refuses("geometry", CW_ERR_IO, "geometry/made.txt: is not as cutwater-geometry wrote it: damaged or replaced; run");
  write_text(in_test_folder("geometry/made.txt"), "a solid\n");
  assert_int_equal(unlink(in_test_folder("mesh/made.txt")), 0);
  refuses("mesh", CW_ERR_IO, "mesh/made.txt: cannot be read: No such file");
  assert_int_equal(cw_make_directory(in_test_folder("mesh/made.txt")), CW_OK);
  refuses("mesh", CW_ERR_IO, "mesh/made.txt: cannot be read: it is no plain file");
}

// The same stage again with the same result is no other geometry, whatever its record says of time and memory.
static void what_was_made_from_others_is_told(void **state) {
  write_stage("geometry", (const char *const[]){NULL}, "a solid\n");
  assert_int_equal(cw_stage_files_check(test_folder, "mesh"), CW_OK);
  write_stage("geometry", (const char *const[]){NULL}, "another solid\n");
  assert_int_equal(cw_stage_files_check(test_folder, "geometry"), CW_OK);
  refuses("mesh", CW_ERR_INPUT, "mesh: was made from other files than lie in ");
  write_stage("mesh", (const char *const[]){"geometry", NULL}, "a mesh\n");
  assert_int_equal(cw_stage_files_check(test_folder, "mesh"), CW_OK);
  refuses("export", CW_ERR_INPUT, "/geometry; run cutwater-export again");
}

// A file of the user's: changed it is told, missing it is not.
static void a_changed_input_is_told(void **state) {
  CwRecord *record;
  write_text(in_test_folder("pump.Step"), "a drawing\n");
  assert_int_equal(cw_record_start("geometry", NULL, &record), CW_OK);
  assert_int_equal(cw_record_input(record, in_test_folder("none")), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "/none: cannot be read: No such file"));
  assert_int_equal(cw_record_input(record, in_test_folder("pump.Step")), CW_OK);
  assert_int_equal(cw_record_write(record, in_test_folder("geometry/record.json")), CW_OK);
  cw_record_free(record);
  assert_int_equal(cw_stage_files_check(test_folder, "geometry"), CW_OK);
  write_text(in_test_folder("pump.Step"), "a drawinh\n");
  refuses("geometry", CW_ERR_INPUT, "/pump.Step: has changed since ");
  refuses("geometry", CW_ERR_INPUT, "/geometry was made from it; run cutwater-geometry again");
  assert_int_equal(unlink(in_test_folder("pump.Step")), 0);
  assert_int_equal(cw_stage_files_check(test_folder, "geometry"), CW_OK);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(all_as_written_is_taken, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(a_changed_file_is_told_by_its_name, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(what_was_made_from_others_is_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(a_changed_input_is_told, make_run, clear_test_folder),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
