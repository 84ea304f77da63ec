// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "pipeline/atomic_file.h"
#include "pipeline/case_origin.h"
#include "pipeline/case_read.h"
#include "pipeline/case_schema.h"
#include "pipeline/record.h"
#include "pipeline/sealed_json.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static CwCase paper;

static int make_run(void **state) {
  CwRecord *record;
  assert_int_equal(make_test_folder(state), 0);
  assert_int_equal(cw_case_read(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", &paper), CW_OK);
  assert_int_equal(cw_make_directory(in_test_folder("geometry")), CW_OK);
  assert_int_equal(cw_record_start("geometry", NULL, &record), CW_OK);
  assert_int_equal(cw_record_case(record, &paper), CW_OK);
  assert_int_equal(cw_record_write(record, in_test_folder("geometry/record.json")), CW_OK);
  cw_record_free(record);
  return 0;
}

static void the_same_case_is_taken(void **state) {
  assert_int_equal(cw_case_origin_check(&paper, test_folder, "geometry"), CW_OK);
}

// Of each number of the case: another value is refused just where the pump follows from the key.
static void every_key_of_the_pump_counts_and_no_other(void **state) {
  int shape = 0;
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    if (key->type == CW_KEY_NAME || key->type == CW_KEY_LIST) continue;
    CwCase other = paper;
    double value = cw_case_key_value(key, &other);
    char name[CW_KEY_PATH_SIZE];
    cw_case_key_path(key, name);
    if (key->type == CW_KEY_REAL)
      value = isnan(value) ? key->least : value == 0 ? key->most : value * (1 + 1e-9);
    else
      value = key->type == CW_KEY_CHOICE && value > 0 ? 0 : value + 1;
    cw_case_key_set(key, value, &other);
    CwStatus status = cw_case_origin_check(&other, test_folder, "geometry");
    if (status != (cw_case_key_shapes_pump(key) ? CW_ERR_INPUT : CW_OK)) fail_msg("%s: status %d", name, status);
    if (status != CW_OK && !strstr(cw_fail_message(), name)) fail_msg("%s: %s", name, cw_fail_message());
    shape += status != CW_OK;
  }
  assert_true(shape > 50 && shape + 40 < (int)cw_case_key_count);
}

static void the_line_says_what_differs(void **state) {
  char wanted[300];
  CwCase other = paper;
  other.impeller.outlet_diameter = 0.22;
  assert_int_equal(cw_case_origin_check(&other, test_folder, "geometry"), CW_ERR_INPUT);
  snprintf(
      wanted, sizeof wanted,
      "%s/geometry: made with impeller.outlet_diameter_mm: 200, the case file has 220; allowed: the same pump, run "
      "cutwater-geometry on this case file first",
      test_folder);
  assert_string_equal(cw_fail_message(), wanted);
  other.impeller.outlet_diameter = NAN;
  assert_int_equal(cw_case_origin_check(&other, test_folder, "geometry"), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "outlet_diameter_mm: 200, the case file has (left out); "));
  other = paper;
  strcpy(other.name, "other");
  other.impeller.outlet_diameter = 0.22;
  assert_int_equal(cw_case_origin_check(&other, test_folder, "geometry"), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "geometry: made with name: paper, the case file has other; "));
}

// 8 inches are 203.2 mm, though not in each bit.
static void another_unit_is_the_same_pump(void **state) {
  CwCase other = paper;
  other.impeller.outlet_diameter = nextafter(paper.impeller.outlet_diameter, 1);
  assert_int_equal(cw_case_origin_check(&other, test_folder, "geometry"), CW_OK);
}

static void a_record_that_is_missing_or_broken_is_told(void **state) {
  assert_int_equal(cw_case_origin_check(&paper, test_folder, "mesh"), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "mesh/record.json: it is missing; cutwater-mesh writes it"));
  json_t *none = json_pack("{s:{}}", "results");
  assert_int_equal(cw_sealed_json_write(none, in_test_folder("geometry/record.json")), CW_OK);
  json_decref(none);
  assert_int_equal(cw_case_origin_check(&paper, test_folder, "geometry"), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "geometry/record.json: does not say of which case; run cutwater-geometry"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_same_case_is_taken),
      cmocka_unit_test(every_key_of_the_pump_counts_and_no_other),
      cmocka_unit_test(the_line_says_what_differs),
      cmocka_unit_test(another_unit_is_the_same_pump),
      cmocka_unit_test(a_record_that_is_missing_or_broken_is_told),
  };
  return cmocka_run_group_tests(tests, make_run, clear_test_folder);
}
