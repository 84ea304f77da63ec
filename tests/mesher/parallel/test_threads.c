// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/threads.h"

#include <stdatomic.h>
#include <string.h>

#include "tests/unit_test.h"

enum { ITEMS = 5000, ROUNDS = 200 };

static atomic_int times[ITEMS];

static CwStatus count(void *given, int32_t item) {
  atomic_fetch_add(&times[item], 1);
  return CW_OK;
}

static void each_item_is_done_once_a_round(void **state) {
  for (int threads = 1; threads <= 5; threads += 2) {
    CwThreads *made = NULL;
    memset(times, 0, sizeof times);
    assert_int_equal(cw_threads_make(threads, NULL, &made), CW_OK);
    for (int round = 0; round < ROUNDS; round++)
      assert_int_equal(cw_threads_run(made, round % 2 ? ITEMS : 3, count, NULL), CW_OK);
    assert_int_equal(cw_threads_run(made, 0, count, NULL), CW_OK);
    cw_threads_free(&made);
    assert_null(made);
    for (int i = 0; i < ITEMS; i++) assert_int_equal(times[i], i < 3 ? ROUNDS : ROUNDS / 2);
  }
  cw_threads_free(&(CwThreads *){NULL});
}

static CwStatus fail_from_700(void *given, int32_t item) {
  return item >= 700 && item % 7 == 0 ? CW_FAIL(CW_ERR_MESH, "item %d", item) : CW_OK;
}

static void the_first_failing_item_is_told(void **state) {
  CwThreads *made = NULL;
  assert_int_equal(cw_threads_make(4, NULL, &made), CW_OK);
  for (int round = 0; round < ROUNDS; round++) {
    cw_fail_clear();
    assert_int_equal(cw_threads_run(made, ITEMS, fail_from_700, NULL), CW_ERR_MESH);
    assert_string_equal(cw_fail_message(), "item 700");
  }
  assert_int_equal(cw_threads_run(made, 700, fail_from_700, NULL), CW_OK);
  cw_threads_free(&made);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_item_is_done_once_a_round),
      cmocka_unit_test(the_first_failing_item_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
