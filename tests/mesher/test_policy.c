// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/policy.h"
#include "tests/unit_test.h"

static CwStatus read_text(const char *text, CwPolicy *policy) {
  FILE *file = fmemopen((void *)(uintptr_t)text, strlen(text), "r");
  assert_non_null(file);
  CwStatus status = cw_policy_read(file, "numbers", policy);
  fclose(file);
  return status;
}

static void lines_change_their_numbers_alone(void **unused) {
  CwPolicy policy = cw_policy;
  assert_int_equal(read_text("# for a trial\nimprove_below 0.375 # sine\n\nsearch_vain\t17\n", &policy), CW_OK);
  assert_true(policy.improve_below == 0.375);
  assert_int_equal(policy.search_vain, 17);
  policy.improve_below = cw_policy.improve_below;
  policy.search_vain = cw_policy.search_vain;
  assert_memory_equal(&policy, &cw_policy, sizeof policy);
}

static void refused(const char *text, const char *part) {
  CwPolicy policy = cw_policy;
  cw_fail_clear();
  assert_int_equal(read_text(text, &policy), CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), part)) fail_msg("\"%s\" lacks \"%s\"", cw_fail_message(), part);
}

static void wrong_lines_are_refused_with_their_number(void **unused) {
  refused("improve_below 0.4\nimprove_blow 0.4\n", "numbers:2: there is no number `improve_blow`");
  refused("improve_below much\n", "numbers:1: `much` is not a number");
  refused("search_vain 1.5\n", "`1.5` is not a whole number for `search_vain`");
  refused("improve_below\n", "numbers:1: a line is `name value`");
  refused("improve_below nan\n", "is not a number");
}

#define NUMBER(type, name, value, off, unit, meaning) {#name, #value, unit, meaning},
static const char *const listed[][4] = {
#include "mesher/policy_table.h"
};
#undef NUMBER

// Each number of the list, read by its name, has its place in the table; none stands there without unit and meaning.
static void all_numbers_can_be_read(void **unused) {
  CwPolicy policy;
  char line[160];
  memset(&policy, 0, sizeof policy);
  for (size_t k = 0; k < sizeof listed / sizeof *listed; k++) {
    snprintf(line, sizeof line, "%s %s\n", listed[k][0], listed[k][1]);
    assert_int_equal(read_text(line, &policy), CW_OK);
    assert_true(strlen(listed[k][2]) > 0 && strlen(listed[k][3]) > 5);
    for (size_t m = 0; m < k; m++) assert_string_not_equal(listed[m][0], listed[k][0]);
  }
  assert_memory_equal(&policy, &cw_policy, sizeof policy);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_change_their_numbers_alone),
      cmocka_unit_test(wrong_lines_are_refused_with_their_number),
      cmocka_unit_test(all_numbers_can_be_read),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
