// SPDX-License-Identifier: AGPL-3.0-or-later
// What the tables of the export contradict; the other rules are in test_case_read.c.
#include <string.h>

#include "given_case.h"
#include "pipeline/case_check.h"
#include "tests/unit_test.h"

static CwStatus read_with(const char *lines, CwCase *table) {
  return read_given("name: test\noperating_point:\n  flow_rate_m3_per_h: 25\n  head_m: 10\n  speed_rpm: 1450\n", lines,
                    table);
}

// CFX and code_saturne read pump.cgns, which the case may name as a format or not.
static void the_profile_goes_with_what_reads_the_file(void **state) {
  CwCase table;
  assert_int_equal(read_with("", &table), CW_OK);
  assert_int_equal(table.output.cgns_profile, CW_CGNS_STRICT);
  assert_int_equal(read_with("cgns: {profile: vendor}\nexport: {formats: [cgns, openfoam, fluent]}", &table), CW_OK);
  assert_int_equal(table.output.cgns_profile, CW_CGNS_VENDOR);
  static const struct {
    const char *lines, *reader;
  } bad[] = {{"cgns: {profile: vendor}", "cfx"},
             {"cgns: {profile: vendor}\nexport: {formats: code_saturne}", "code_saturne"}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
    char wanted[300];
    assert_int_equal(read_with(bad[i].lines, &table), CW_ERR_INPUT);
    snprintf(
        wanted, sizeof wanted,
        ":6:17: cgns.profile: vendor contradicts export.formats, whose %s reads pump.cgns in the standard's order; "
        "allowed: strict, or formats without cfx and code_saturne ([cgns, openfoam])",
        bad[i].reader);
    assert_string_equal(strchr(cw_fail_message(), ':'), wanted);
  }
}

static void a_part_has_two_cells(void **state) {
  CwCase table;
  assert_int_equal(read_with("mesh: {cells: 50000}\nopenfoam: {processors: 25000}", &table), CW_OK);
  assert_int_equal(cw_case_check_parts("case.yaml", &table), CW_OK);
  table.output.foam_processors = 100000;
  assert_int_equal(cw_case_check_parts("case.yaml", &table), CW_ERR_INPUT);
  assert_string_equal(cw_fail_message(), "case.yaml: openfoam.processors: 100000 parts of 50000 cells (mesh.cells, or "
                                         "--cells); allowed: 1 to 25000, two cells a part");
  table.output.formats = 1 << CW_FORMAT_CGNS; // nothing is divided
  assert_int_equal(cw_case_check_parts("case.yaml", &table), CW_OK);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_profile_goes_with_what_reads_the_file),
                                     cmocka_unit_test(a_part_has_two_cells)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
