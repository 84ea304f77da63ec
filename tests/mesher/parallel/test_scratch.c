// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/scratch.h"

#include <string.h>

#include "mesher/parallel/threads.h"
#include "tests/unit_test.h"

enum { SIZE = 1000, TASKS = 3000 };

// Each task finds zeros, has the array for itself, and leaves zeros.
static CwStatus use(void *given, int32_t item) {
  CwStatus status = CW_OK;
  void *array = NULL;
  CW_TRY(cw_scratch_take(given, &array));
  for (char *at = array; at < (char *)array + SIZE; at++) {
    CW_REQUIRE(*at == 0, CW_ERR_MESH, "task %d finds %d", item, *at);
    *at = (char)(item % 100 + 1);
  }
  for (char *at = array; at < (char *)array + SIZE; at++)
    CW_REQUIRE(*at == (char)(item % 100 + 1), CW_ERR_MESH, "another task writes to that of task %d", item);
  memset(array, 0, SIZE);
done:
  cw_scratch_give(given, array);
  return status;
}

static void each_task_has_one_for_itself(void **state) {
  CwScratch *scratch = NULL;
  CwThreads *threads = NULL;
  assert_int_equal(cw_scratch_make(SIZE, &scratch), CW_OK);
  assert_int_equal(cw_threads_make(4, NULL, &threads), CW_OK);
  assert_int_equal(cw_threads_run(threads, TASKS, use, scratch), CW_OK);
  cw_threads_free(&threads);
  cw_scratch_free(&scratch);
  assert_null(scratch);
}

static void what_was_given_back_is_taken_again(void **state) {
  CwScratch *scratch = NULL;
  void *taken[40], *again;
  assert_int_equal(cw_scratch_make(SIZE, &scratch), CW_OK);
  for (int i = 0; i < 40; i++) assert_int_equal(cw_scratch_take(scratch, &taken[i]), CW_OK);
  for (int i = 0; i < 40; i++) cw_scratch_give(scratch, taken[i]);
  for (int i = 40; i-- > 0;) {
    assert_int_equal(cw_scratch_take(scratch, &again), CW_OK);
    assert_ptr_equal(again, taken[i]);
  }
  for (int i = 0; i < 40; i++) cw_scratch_give(scratch, taken[i]);
  cw_scratch_give(scratch, NULL);
  cw_scratch_free(&scratch);
  cw_scratch_free(&scratch);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_task_has_one_for_itself),
      cmocka_unit_test(what_was_given_back_is_taken_again),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
