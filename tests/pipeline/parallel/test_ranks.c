// SPDX-License-Identifier: AGPL-3.0-or-later
// What the ranks hand each other, in several messages each (message): the program starts itself under mpirun.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/parallel/message.h"
#include "pipeline/parallel/ranks.h"
#include "tests/unit_test.h"

enum { ITEMS = 200 }; // of each rank; the second has none

typedef struct {
  int64_t number[25];
} Item;

static int64_t count_of(int rank) {
  return rank == 1 ? 0 : ITEMS + rank;
}

static int64_t number_of(int rank, int64_t item) {
  return 1000000007 * (int64_t)rank + item;
}

static int gather_wrong(const CwRanks *ranks) {
  int64_t count = count_of(ranks->rank), total = -1, at = 0, expected = 0;
  Item *mine = calloc((size_t)count + 1, sizeof *mine), *all = NULL;
  int wrong = 0;
  for (int64_t i = 0; i < count; ++i) mine[i].number[24] = number_of(ranks->rank, i);
  wrong += cw_ranks_gather(ranks, mine, count, sizeof *mine, (void **)&all, &total) != CW_OK;
  for (int r = 0; r < ranks->size; ++r) expected += count_of(r);
  wrong += total != (ranks->rank == 0 ? expected : 0) || (ranks->rank > 0 && all);
  for (int r = 0; ranks->rank == 0 && r < ranks->size; ++r)
    for (int64_t i = 0; i < count_of(r); ++i) wrong += all[at++].number[24] != number_of(r, i);
  free(all);
  free(mine);
  return wrong;
}

static int spread_wrong(const CwRanks *ranks) {
  Item *items = calloc(ITEMS, sizeof *items);
  int64_t *sums = calloc(25 * ITEMS, sizeof *sums);
  int wrong = 0;
  for (int64_t i = 0; i < ITEMS && ranks->rank == 0; ++i) items[i].number[0] = number_of(7, i);
  cw_ranks_broadcast(ranks, items, ITEMS, sizeof *items);
  for (int64_t i = 0; i < ITEMS; ++i) wrong += items[i].number[0] != number_of(7, i);
  for (int64_t i = 0; i < 25 * ITEMS; ++i) sums[i] = ranks->rank + i;
  cw_ranks_reduce(ranks, sums, 25 * ITEMS, MPI_INT64_T, MPI_SUM);
  for (int64_t i = 0; i < 25 * ITEMS; ++i) wrong += sums[i] != ranks->size * i + ranks->size * (ranks->size - 1) / 2;
  int32_t *parts = (int32_t *)sums; // twice as many in the same place
  for (int32_t i = 0; i < 50 * ITEMS; ++i) parts[i] = ranks->rank - i;
  cw_ranks_reduce(ranks, parts, 50 * ITEMS, MPI_INT32_T, MPI_MAX);
  for (int32_t i = 0; i < 50 * ITEMS; ++i) wrong += parts[i] != ranks->size - 1 - i;
  for (int64_t i = 0; i < ITEMS; ++i) sums[i] = ranks->rank + i;
  cw_ranks_before(ranks, sums, ITEMS);
  for (int64_t i = 0; i < ITEMS; ++i)
    wrong += sums[i] != ranks->rank * i + (int64_t)ranks->rank * (ranks->rank - 1) / 2;
  free(sums);
  free(items);
  return wrong;
}

// All ranks but the first fail; the run ends everywhere with the status of the second, which rank 0 tells.
static int end_wrong(const CwRanks *ranks) {
  CwStatus status = CW_OK;
  if (ranks->rank > 0) status = CW_FAIL(ranks->rank == 1 ? CW_ERR_IO : CW_ERR_MEMORY, "rank %d", ranks->rank);
  status = cw_ranks_agree(ranks, status);
  int code = cw_ranks_end(ranks, status, NULL);
  return code != (ranks->size > 1 ? CW_ERR_IO : CW_OK) || (ranks->size > 1 && strcmp(cw_fail_message(), "rank 1") != 0);
}

static int be_a_rank(int argc, char **argv) {
  CwRanks ranks = {.comm = MPI_COMM_WORLD};
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(ranks.comm, &ranks.rank);
  MPI_Comm_size(ranks.comm, &ranks.size);
  int wrong = gather_wrong(&ranks) + spread_wrong(&ranks) + end_wrong(&ranks);
  MPI_Finalize();
  return wrong != 0;
}

// By messages of so many bytes: the default, of which one takes all; more than one item; less than one.
static void items_come_whole_and_in_order(void **state) {
  static const char *const most[] = {"", "10000", "150", "7"};
  char command[4200], self[4000] = {0};
  assert_true(readlink("/proc/self/exe", self, sizeof self - 1) > 0);
  for (size_t k = 0; k < sizeof most / sizeof *most; ++k) {
    setenv("CUTWATER_MESSAGE_BYTES", most[k], 1);
    for (int ranks = 1; ranks <= 3; ++ranks) {
      snprintf(command, sizeof command, "mpirun -q --oversubscribe -n %d '%s' rank", ranks, self);
      if (system(command) != 0) fail_msg("%d ranks, messages of '%s' bytes", ranks, most[k]);
    }
  }
  unsetenv("CUTWATER_MESSAGE_BYTES");
}

static void a_message_holds_what_mpi_can_count(void **state) {
  unsetenv("CUTWATER_MESSAGE_BYTES");
  assert_int_equal(cw_message_items(5, 8), 5);
  assert_int_equal(cw_message_items((int64_t)1 << 40, 1), 1 << 26);
  assert_int_equal(cw_message_items((int64_t)1 << 40, 100), (1 << 26) / 100);
  assert_int_equal(cw_message_items((int64_t)1 << 40, (size_t)1 << 30), 1);
  setenv("CUTWATER_MESSAGE_BYTES", "99", 1);
  assert_int_equal(cw_message_items(50, 8), 12);
  assert_int_equal(cw_message_items(3, 100), 1);
  unsetenv("CUTWATER_MESSAGE_BYTES");
}

int main(int argc, char **argv) {
  if (argc > 1) return be_a_rank(argc, argv);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_message_holds_what_mpi_can_count),
                                     cmocka_unit_test(items_come_whole_and_in_order)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
