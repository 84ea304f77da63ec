// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "mesher/policy.h"

static CwStatus read_text(const char *text, CwFillPolicy *policy) {
  FILE *file = fmemopen((void *)(uintptr_t)text, strlen(text), "r");
  assert_non_null(file);
  CwStatus status = cw_policy_read(file, "numbers", policy);
  fclose(file);
  return status;
}

static void lines_change_their_numbers_alone(void **unused) {
  CwFillPolicy policy = cw_fill_policy;
  assert_int_equal(read_text("# for a trial\nimprove_below 0.375 # sine\n\nsearch_tries\t17\n", &policy), CW_OK);
  assert_true(policy.improve_below == 0.375);
  assert_int_equal(policy.search_tries, 17);
  policy.improve_below = cw_fill_policy.improve_below;
  policy.search_tries = cw_fill_policy.search_tries;
  assert_memory_equal(&policy, &cw_fill_policy, sizeof policy);
}

static void refused(const char *text, const char *part) {
  CwFillPolicy policy = cw_fill_policy;
  cw_fail_clear();
  assert_int_equal(read_text(text, &policy), CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), part)) fail_msg("\"%s\" lacks \"%s\"", cw_fail_message(), part);
}

static void wrong_lines_are_refused_with_their_number(void **unused) {
  refused("improve_below 0.4\nimprove_blow 0.4\n", "numbers:2: there is no number `improve_blow`");
  refused("improve_below much\n", "numbers:1: `much` is not a number");
  refused("search_tries 1.5\n", "`1.5` is not a whole number for `search_tries`");
  refused("improve_below\n", "numbers:1: a line is `name value`");
  refused("improve_below nan\n", "is not a number");
}

// What is printed, read again, gives the same bits; each name stands there once, with a unit and a meaning.
static void table_holds_all_numbers(void **unused) {
  char *text = NULL, *at, *line, *rest;
  size_t size = 0;
  CwFillPolicy policy;
  int lines = 0;
  FILE *file = open_memstream(&text, &size);
  cw_policy_print(file, &cw_fill_policy);
  fclose(file);
  memset(&policy, 0, sizeof policy);
  for (rest = text; (line = strtok_r(rest, "\n", &at)); rest = NULL, lines++) {
    char name[64], value[64], unit[64], both[160];
    assert_int_equal(sscanf(line, "%63[^\t]\t%63[^\t]\t%63[^\t]", name, value, unit), 3);
    snprintf(both, sizeof both, "%s %s\n", name, value);
    assert_int_equal(read_text(both, &policy), CW_OK);
  }
  assert_memory_equal(&policy, &cw_fill_policy, sizeof policy);
  assert_true(lines > 40);
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_change_their_numbers_alone),
      cmocka_unit_test(wrong_lines_are_refused_with_their_number),
      cmocka_unit_test(table_holds_all_numbers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
