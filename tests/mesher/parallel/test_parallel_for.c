// SPDX-License-Identifier: AGPL-3.0-or-later

#include "launch.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/schedule.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static CwLog *test_log;

enum { COUNT = 10000 }; // more than one block, and one that is not full

static CwStatus square(void *context, int32_t item, void *out) {
  const int64_t *shift = context;
  if (item % 3) *(int64_t *)out = (int64_t)item * item + *shift;
  return CW_OK;
}

static CwStatus fail_late(void *context, int32_t item, void *out) {
  return item == 9000 ? CW_FAIL(CW_ERR_MESH, "item %d", item) : CW_OK;
}

static void every_item_has_its_place(void **state) {
  static int64_t out[COUNT];
  int64_t shift = 7;
  for (int32_t i = 0; i < COUNT; i++) out[i] = -1;
  assert_int_equal(cw_parallel_for(NULL, "squares", COUNT, sizeof *out, square, &shift, out), CW_OK);
  for (int32_t i = 0; i < COUNT; i++) assert_int_equal(out[i], i % 3 ? (int64_t)i * i + 7 : 0);
  assert_int_equal(cw_parallel_for(NULL, "nothing", 0, sizeof *out, square, &shift, out), CW_OK);
}

// Item i has i % 4 entries, numbered.
static CwStatus number(void *context, int32_t item, void *out) {
  int64_t *entry = out;
  for (int32_t k = 0; k < item % 4; k++) entry[k] = 10 * (int64_t)item + k;
  return CW_OK;
}

static void lists_stand_one_after_the_other(void **state) {
  static int32_t start[COUNT + 1];
  static int64_t out[2 * COUNT];
  for (int32_t i = 0; i < COUNT; i++) start[i + 1] = start[i] + i % 4;
  assert_int_equal(cw_parallel_for_lists(NULL, "lists", COUNT, start, sizeof *out, number, NULL, out), CW_OK);
  for (int32_t i = 0; i < COUNT; i++) {
    for (int32_t k = start[i]; k < start[i + 1]; k++) assert_int_equal(out[k], 10 * (int64_t)i + k - start[i]);
  }
}

static CwStatus mark(void *context, int32_t item, void *out) {
  if (item >= COUNT - 100) *(int64_t *)out = item;
  return CW_OK;
}

// Lists of the last items alone: whole blocks of the ranks are empty.
static int be_a_rank(int argc, char **argv) {
  static int32_t start[COUNT + 1];
  int64_t out[100] = {0};
  int wrong = 0;
  CwTeam *all;
  begin_as_rank(&argc, &argv, &all);
  CwContext context = {.team = all};
  int rank = cw_team_rank(all);
  cw_log_open("test", NULL, rank == 0, 0, &test_log);
  context.log = test_log;
  for (int32_t i = 0; i < COUNT; i++) start[i + 1] = start[i] + (i >= COUNT - 100);
  CwStatus status = cw_parallel_for_lists(&context, "lists", COUNT, start, sizeof *out, mark, NULL, out);
  if (status != CW_OK) return cw_mpi_fail(test_log, status);
  for (int k = 0; k < 100; k++) wrong += out[k] != COUNT - 100 + k;
  printf("RANK %d WRONG %d\n", rank, wrong);
  cw_log_close(&test_log);
  return end_as_rank(all, wrong != 0);
}

static void blocks_may_be_empty(void **state) {
  launch_and_find_right(3, "empty", 1);
}

static void a_failure_is_given_back(void **state) {
  static int64_t out[COUNT];
  assert_int_equal(cw_parallel_for(NULL, "failing", COUNT, sizeof *out, fail_late, NULL, out), CW_ERR_MESH);
  assert_string_equal(cw_fail_message(), "item 9000");
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_item_has_its_place),
                                     cmocka_unit_test(lists_stand_one_after_the_other),
                                     cmocka_unit_test(blocks_may_be_empty), cmocka_unit_test(a_failure_is_given_back)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
