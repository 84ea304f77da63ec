// SPDX-License-Identifier: AGPL-3.0-or-later
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/status.h"
#include "tests/unit_test.h"

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
  char trace[200];
  snprintf(trace, sizeof trace, "%s", cw_fail_trace());
  cw_fail_place("case.yaml");
  assert_string_equal(cw_fail_message(), "case.yaml: rotor: cannot read");
  cw_fail_place("case.yaml"); // told once
  assert_string_equal(cw_fail_message(), "case.yaml: rotor: cannot read");
  assert_string_equal(cw_fail_trace(), trace);
}

// A library calls it by another name, or tells of what it came to.
static void a_failed_allocation_is_told_as_one(void **state) {
  errno = ENOMEM;
  assert_int_equal(CW_FAIL(CW_ERR_GEOMETRY, "rotor: %s", "no solid"), CW_ERR_MEMORY);
  assert_string_equal(cw_fail_message(), "out of memory: rotor: no solid");
  assert_int_equal(CW_FAIL(CW_ERR_USAGE, "no such option"), CW_ERR_USAGE);
  assert_string_equal(cw_fail_message(), "no such option");
  errno = ENOENT;
  assert_int_equal(CW_FAIL(CW_ERR_GEOMETRY, "rotor: no solid"), CW_ERR_GEOMETRY);
  assert_string_equal(cw_fail_message(), "rotor: no solid");
  errno = 0;
}

static void every_code_has_a_text(void **state) {
#define CHECK_TEXT(name, value, text) assert_string_equal(cw_status_text(name), text);
  CW_STATUS_LIST(CHECK_TEXT)
}

static CwStatus list_numbers(int32_t count, int32_t **list, int32_t *space, int *moves) {
  CwStatus status = CW_OK;
  for (int32_t i = 0; i < count; i++) {
    int32_t before = *space;
    CW_GROW(*list, *space, i + 1);
    *moves += *space != before;
    (*list)[i] = i;
  }
done:
  return status;
}

static void a_list_grows_by_doubling_and_keeps_its_items(void **state) {
  int32_t *list = NULL, space = 0;
  int moves = 0;
  assert_int_equal(list_numbers(100000, &list, &space, &moves), CW_OK);
  assert_in_range(space, 100000, 400000);
  assert_in_range(moves, 1, 16);
  for (int32_t i = 0; i < 100000; i++) assert_int_equal(list[i], i);
  free(list);
}

// Neither more than the memory nor more than the type of the count can hold; the list is still there.
static CwStatus too_many(double **list, int32_t *space, int64_t wanted) {
  CwStatus status = CW_OK;
  CW_GROW(*list, *space, wanted);
done:
  return status;
}

static void a_list_that_cannot_grow_is_told(void **state) {
  int32_t space = 0;
  double *list = NULL;
  assert_int_equal(too_many(&list, &space, 3), CW_OK);
  double *before = list;
  const int32_t room = space;
  list[0] = 7;
  assert_int_equal(too_many(&list, &space, (int64_t)1 << 30), CW_ERR_MEMORY);
  assert_string_equal(cw_fail_message(), "out of memory: 2147483712 items of 8 bytes");
  assert_true(list == before && space == room && list[0] == 7);
  free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(failure_carries_message_and_trace),
      cmocka_unit_test(message_may_be_built_from_the_old_one),
      cmocka_unit_test(a_failed_allocation_is_told_as_one),
      cmocka_unit_test(every_code_has_a_text),
      cmocka_unit_test(a_list_grows_by_doubling_and_keeps_its_items),
      cmocka_unit_test(a_list_that_cannot_grow_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
