// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/beside.h"

#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"

static const char *file(void) {
  return in_test_folder("beside.txt");
}

static CwStatus write_text(const void *given) {
  CwStatus status = CW_OK;
  FILE *out = fopen(file(), "w");
  CW_REQUIRE(out, CW_ERR_IO, "%s: cannot be written", file());
  fprintf(out, "%s %d\n", (const char *)given, getpid());
done:
  if (out) fclose(out);
  return status;
}

static CwStatus refuse(const void *given) {
  return CW_FAIL(CW_ERR_GEOMETRY, "no %s", (const char *)given);
}

static CwStatus die(const void *given) {
  raise(*(const int *)given);
  return CW_OK;
}

// What it wrote is there, of another process.
static void it_runs_beside(void **state) {
  CwBeside *beside = NULL;
  char text[20] = "";
  int process = 0;
  assert_int_equal(cw_beside_start(write_text, "flow", &beside), CW_OK);
  assert_int_equal(cw_beside_end(&beside, file()), CW_OK);
  assert_null(beside);
  FILE *in = fopen(file(), "r");
  assert_non_null(in);
  assert_int_equal(fscanf(in, "%19s %d", text, &process), 2);
  assert_string_equal(text, "flow");
  assert_int_not_equal(process, getpid());
  fclose(in);
  unlink(file());
}

static void its_failure_comes_back(void **state) {
  CwBeside *beside = NULL;
  assert_int_equal(cw_beside_start(refuse, "solid", &beside), CW_OK);
  assert_string_equal(cw_fail_message(), "");
  assert_int_equal(cw_beside_end(&beside, file()), CW_ERR_GEOMETRY);
  assert_string_equal(cw_fail_message(), "no solid");
  assert_int_equal(cw_beside_end(&beside, file()), CW_OK); // there is none
  cw_fail_clear();
}

static void a_signal_is_told(void **state) {
  static const int signals[] = {SIGKILL, SIGTERM};
  for (int i = 0; i < 2; i++) {
    CwBeside *beside = NULL;
    char expected[sizeof test_folder + 180];
    assert_int_equal(cw_beside_start(die, &signals[i], &beside), CW_OK);
    assert_int_equal(cw_beside_end(&beside, file()), CW_ERR_LIBRARY);
    snprintf(expected, sizeof expected, "%s: the process that makes it was ended by signal %d", file(), signals[i]);
    assert_string_equal(cw_fail_message(), expected);
    cw_fail_clear();
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_runs_beside),
      cmocka_unit_test(its_failure_comes_back),
      cmocka_unit_test(a_signal_is_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
