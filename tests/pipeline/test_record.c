// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/hash.h"
#include "pipeline/log.h"
#include "pipeline/record.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static CwLog *test_log;

static char path[sizeof test_folder + 32];

static int make_folder(void **state) {
  if (make_test_folder(state)) return -1;
  snprintf(path, sizeof path, "%s/record.json", test_folder);
  return 0;
}

static int remove_files(void **state) {
  unlink(path);
  return remove_test_folder(state);
}

static void record_is_written_whole_and_in_order(void **state) {
  CwRecord *record = NULL;
  char expected[2000];
  cw_log_open("mesh", NULL, 0, 0, &test_log); // speaks to nobody, keeps the warnings
  cw_log_warn(test_log, "narrow gap at %d mm in \"pa\xffper\"", 5);
  assert_int_equal(cw_record_start("mesh", test_log, &record), CW_OK);
  assert_int_equal(cw_record_step(record, "surface", 1.5, 20, "faces"), CW_OK);
  assert_int_equal(cw_record_step(record, "fill", 0.25, 3000000000, "cells"), CW_OK);
  assert_int_equal(cw_record_integer(record, "zeta", 1), CW_OK);
  assert_int_equal(cw_record_number(record, "alpha", 0.1), CW_OK);
  assert_int_equal(cw_record_number(record, "undefined", NAN), CW_OK);
  assert_int_equal(cw_record_number(record, "endless", INFINITY), CW_OK);
  assert_int_equal(cw_record_json(record, "list", json_pack("[i, i]", 1, 2)), CW_OK);
  assert_int_equal(cw_record_json(record, "list2", NULL), CW_ERR_MEMORY);
  assert_int_equal(cw_record_integer(record, "zeta", 2), CW_OK); // keeps its place
  assert_int_equal(cw_record_file_digest(record, "known", "00ff"), CW_OK);
  assert_int_equal(cw_record_file(record, test_folder, "none"), CW_ERR_IO);
  cw_record_set_peak_memory(record, 5000000000);
  assert_int_equal(cw_record_write(record, path), CW_OK);
  cw_record_free(record);
  cw_log_close(&test_log);

  char *text = read_whole(path, NULL);
  double seconds = -1;
  const char *place = strstr(text, "\"seconds\": ");
  assert_non_null(place);
  assert_int_equal(sscanf(place, "\"seconds\": %lf", &seconds), 1);
  assert_true(seconds >= 0 && seconds < 60);
  int digits = (int)strcspn(place + 11, ",");
  snprintf(expected, sizeof expected,
           "{\n  \"stage\": \"mesh\",\n  \"seconds\": %.*s,\n  \"peak_memory_bytes\": 5000000000,\n"
           "  \"steps\": [\n"
           "    {\n      \"name\": \"surface\",\n      \"seconds\": 1.5,\n      \"items\": 20,\n"
           "      \"unit\": \"faces\"\n    },\n"
           "    {\n      \"name\": \"fill\",\n      \"seconds\": 0.25,\n      \"items\": 3000000000,\n"
           "      \"unit\": \"cells\"\n    }\n  ],\n"
           "  \"warnings\": [\n    \"narrow gap at 5 mm in \\\"pa?per\\\"\"\n  ],\n"
           "  \"results\": {\n    \"zeta\": 2,\n    \"alpha\": 0.10000000000000001,\n    \"undefined\": null,\n"
           "    \"endless\": null,\n"
           "    \"list\": [\n      1,\n      2\n    ]\n  },\n"
           "  \"files\": {\n    \"known\": \"00ff\"\n  },\n  \"digest\": \"",
           digits, place + 11);
  char *end = strstr(text, "\"digest\": \"") + strlen("\"digest\": \"");
  assert_int_equal(strspn(end, "0123456789abcdef"), CW_HASH_TEXT - 1);
  assert_string_equal(end + CW_HASH_TEXT - 1, "\"\n}\n");
  *end = '\0';
  assert_string_equal(text, expected);
  free(text);
}

static void peak_memory_is_that_of_the_process(void **state) {
  CwRecord *record = NULL;
  assert_int_equal(cw_record_start("export", test_log, &record), CW_OK);
  assert_int_equal(cw_record_write(record, path), CW_OK);
  assert_int_equal(cw_record_write(record, path), CW_OK); // again, over the old one
  cw_record_free(record);
  json_t *root = json_load_file(path, 0, NULL);
  assert_non_null(root);
  json_int_t bytes = json_integer_value(json_object_get(root, "peak_memory_bytes"));
  assert_true(bytes > 100 << 10 && bytes <= cw_peak_memory_bytes());
  assert_int_equal(json_array_size(json_object_get(root, "steps")), 0);
  assert_int_equal(json_array_size(json_object_get(root, "warnings")), 0);
  assert_int_equal(json_object_size(json_object_get(root, "results")), 0);
  json_decref(root);
}

static void place_that_cannot_be_written_is_an_error(void **state) {
  CwRecord *record = NULL;
  const char *missing = in_test_folder("none/record.json");
  assert_int_equal(cw_record_start("export", test_log, &record), CW_OK);
  assert_int_equal(cw_record_write(record, missing), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "none/record.json: cannot be written: No such file or directory"));
  cw_record_free(record);
  cw_record_free(NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(record_is_written_whole_and_in_order),
      cmocka_unit_test(peak_memory_is_that_of_the_process),
      cmocka_unit_test(place_that_cannot_be_written_is_an_error),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_files);
}
