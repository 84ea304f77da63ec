// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/export_check.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "pipeline/file_digest.h"
#include "pipeline/record.h"
#include "pipeline/sealed_json.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

enum { SIZE = 2 * CW_FILE_BLOCK + 12345 }; // three blocks

// A file of so many bytes, in which one at `place` is another (-1: none).
static void write_file(const char *name, int size, int place) {
  FILE *file = fopen(in_test_folder(name), "wb");
  assert_non_null(file);
  for (int i = 0; i < size; i++) fputc((i * 7 + (i == place)) & 255, file);
  assert_int_equal(fclose(file), 0);
}

static int make_run(void **state) {
  CwRecord *record;
  if (make_test_folder(state)) return -1;
  assert_int_equal(cw_make_directory(in_test_folder("export")), CW_OK);
  write_file("export/pump.cgns", SIZE, -1);
  write_file("export/small", 3, -1);
  assert_int_equal(cw_record_start("export", NULL, &record), CW_OK);
  const char *folder = in_test_folder("export");
  assert_int_equal(cw_record_file(record, folder, "pump.cgns"), CW_OK);
  assert_int_equal(cw_record_file(record, folder, "small"), CW_OK);
  assert_int_equal(cw_record_write(record, in_test_folder("export/record.json")), CW_OK);
  cw_record_free(record);
  return 0;
}

// The outcome of a check by this rank alone; its message stays.
static CwStatus checked(void) {
  const CwRanks alone = {.comm = MPI_COMM_SELF, .rank = 0, .size = 1};
  CwExportCheck *check = NULL;
  json_t *record = NULL;
  assert_int_equal(cw_sealed_json_read(in_test_folder("export/record.json"), &record), CW_OK);
  assert_int_equal(cw_export_check_begin(test_folder, record, &alone, &check), CW_OK);
  const CwStatus status = cw_export_check_end(check);
  cw_export_check_free(&check);
  assert_null(check);
  json_decref(record);
  return status;
}

static void files_as_written_are_taken(void **state) {
  assert_int_equal(checked(), CW_OK);
}

static void a_changed_byte_in_any_block_is_told(void **state) {
  for (int place = 100; place < SIZE; place += CW_FILE_BLOCK) {
    write_file("export/pump.cgns", SIZE, place);
    assert_int_equal(checked(), CW_ERR_IO);
    assert_non_null(strstr(cw_fail_message(), "export/pump.cgns: is not as cutwater-export wrote it"));
  }
  write_file("export/pump.cgns", SIZE, -1);
  write_file("export/small", 3, 1);
  assert_int_equal(checked(), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "export/small: is not as cutwater-export wrote it"));
}

static void a_shorter_file_and_one_that_is_missing_are_told(void **state) {
  write_file("export/pump.cgns", SIZE - 1, -1);
  assert_int_equal(checked(), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "export/pump.cgns: is not as"));
  assert_int_equal(unlink(in_test_folder("export/pump.cgns")), 0);
  assert_int_equal(checked(), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "export/pump.cgns: cannot be read: No such file"));
}

static void it_can_be_given_up(void **state) {
  const CwRanks alone = {.comm = MPI_COMM_SELF, .rank = 0, .size = 1};
  CwExportCheck *check = NULL;
  json_t *record = NULL;
  assert_int_equal(cw_sealed_json_read(in_test_folder("export/record.json"), &record), CW_OK);
  assert_int_equal(cw_export_check_begin(test_folder, record, &alone, &check), CW_OK);
  cw_export_check_free(&check);
  cw_export_check_free(&check);
  json_decref(record);
}

int main(int argc, char **argv) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(files_as_written_are_taken, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(a_changed_byte_in_any_block_is_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(a_shorter_file_and_one_that_is_missing_are_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(it_can_be_given_up, make_run, clear_test_folder),
  };
  MPI_Init(&argc, &argv);
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  MPI_Finalize();
  return failed;
}
