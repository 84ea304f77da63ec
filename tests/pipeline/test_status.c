// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "pipeline/status.h"

static CwStatus inner(int fails) {
  CwStatus status = CW_OK;
  CW_REQUIRE(!fails, CW_ERR_INPUT, "value %d is wrong", 7);
done:
  return status;
}

static CwStatus outer(int fails) {
  CwStatus status = CW_OK;
  CW_TRY(inner(fails));
done:
  return status;
}

static void failure_carries_message_and_trace(void **state) {
  cw_fail_clear();
  assert_int_equal(outer(0), CW_OK);
  assert_string_equal(cw_fail_message(), "");
  assert_int_equal(outer(1), CW_ERR_INPUT);
  assert_string_equal(cw_fail_message(), "value 7 is wrong");
  assert_non_null(strstr(cw_fail_trace(), "inner < "));
  assert_non_null(strstr(cw_fail_trace(), "outer"));
}

static void message_may_be_built_from_the_old_one(void **state) {
  CW_FAIL(CW_ERR_IO, "cannot read");
  CW_FAIL(CW_ERR_IO, "rotor: %s", cw_fail_message());
  assert_string_equal(cw_fail_message(), "rotor: cannot read");
}

static void every_code_has_a_text(void **state) {
#define CHECK_TEXT(name, value, text) assert_string_equal(cw_status_text(name), text);
  CW_STATUS_LIST(CHECK_TEXT)
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(failure_carries_message_and_trace),
      cmocka_unit_test(message_may_be_built_from_the_old_one),
      cmocka_unit_test(every_code_has_a_text),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
