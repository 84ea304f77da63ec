// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/cad_unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static CwStatus read_of(const char *text, double *unit) {
  const char *path = in_test_folder("model.json");
  write_text(path, text);
  const CwStatus status = cw_cad_unit_read(test_folder, unit);
  unlink(path);
  return status;
}

static void unit_of_the_file_or_a_millimetre(void **state) {
  double unit = 0;
  assert_int_equal(cw_cad_unit_read(test_folder, &unit), CW_OK);
  assert_true(unit == 1e-3);
  assert_int_equal(read_of("{\"format\": 1, \"unit_m\": 0.000125}", &unit), CW_OK);
  assert_true(unit == 1e-3 / 8);
}

static void a_file_without_it_is_named(void **state) {
  double unit;
  assert_int_equal(read_of("{\"format\": 1}", &unit), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "model.json"));
  assert_non_null(strstr(cw_fail_message(), "unit_m"));
  cw_fail_clear();
  assert_int_equal(read_of("{\"unit_m\": -1}", &unit), CW_ERR_INPUT);
  cw_fail_clear();
  assert_int_equal(read_of("unit", &unit), CW_ERR_INPUT);
  cw_fail_clear();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(unit_of_the_file_or_a_millimetre),
      cmocka_unit_test(a_file_without_it_is_named),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
