// SPDX-License-Identifier: AGPL-3.0-or-later

#include "launch.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static CwLog *test_log;

enum { SIZE = 150000001 }; // more than two messages

static int64_t most_gathered; // bytes of all ranks at once

// In the place of MPI's.
int MPI_Iallgatherv(const void *from, int count, MPI_Datatype type, void *to, const int *each, const int *place,
                    MPI_Datatype kind, MPI_Comm comm, MPI_Request *request) {
  int ranks;
  int64_t all = 0;
  MPI_Comm_size(comm, &ranks);
  for (int r = 0; r < ranks; r++) all += each[r];
  if (all > most_gathered) most_gathered = all;
  return PMPI_Iallgatherv(from, count, type, to, each, place, kind, comm, request);
}

// Where two ranks of three fail, those that do not get another failure, and later.
static CwStatus fail_where(const char *mode, int rank) {
  CwStatus status = CW_OK;
  CW_REQUIRE(strcmp(mode, "disagree") || rank == 0, CW_ERR_INPUT, "rank %d has no case file", rank);
done:
  return status;
}

static int spread_wrong(const CwTeam *all) {
  int wrong = 0, rank = cw_team_rank(all), ranks = cw_team_ranks(all);
  unsigned char *bytes = malloc(SIZE);
  for (int64_t i = 0; i < SIZE; i += 997) bytes[i] = rank == ranks - 1 ? (unsigned char)(i / 997) : 0;
  cw_team_broadcast(all, bytes, SIZE, ranks - 1);
  for (int64_t i = 0; i < SIZE; i += 997) wrong += bytes[i] != (unsigned char)(i / 997);
  free(bytes);
  double value[2] = {rank, -rank};
  cw_team_most(all, 2, value);
  return wrong + (value[0] != ranks - 1) + (value[1] != 0);
}

// Each rank has other bytes, and so many: the first none, the second some, the others more than go at once, which is 16
// MiB of all ranks together.
static int gather_wrong(const CwTeam *all) {
  enum { MOST = 8 };
  int rank = cw_team_rank(all), ranks = cw_team_ranks(all), wrong = 0;
  int64_t size[MOST];
  void *bytes[MOST];
  for (int r = 0; r < ranks; r++) {
    size[r] = r == 0 ? 0 : r == 1 ? 5 : 20000000 + r;
    unsigned char *own = bytes[r] = malloc((size_t)size[r] + 1);
    for (int64_t i = 0; i < size[r]; i++) own[i] = r == rank ? (unsigned char)(i % 251 + r) : 0;
    own[size[r]] = 77;
  }
  wrong += cw_team_gather(all, size, bytes) != CW_OK;
  wrong += most_gathered > 1 << 24;
  for (int r = 0; r < ranks; r++) {
    const unsigned char *got = bytes[r];
    for (int64_t i = 0; i < size[r]; i++) wrong += got[i] != (unsigned char)(i % 251 + r);
    wrong += got[size[r]] != 77;
    free(bytes[r]);
  }
  return wrong;
}

// The even ranks and the odd ones apart.
static int split_wrong(const CwTeam *all) {
  CwTeam *part;
  int rank = cw_team_rank(all), ranks = cw_team_ranks(all), wrong = cw_team_split(all, rank % 2, &part) != CW_OK;
  wrong += cw_team_rank(part) != rank / 2 || cw_team_ranks(part) != (ranks + 1 - rank % 2) / 2;
  double value = rank;
  cw_team_most(part, 1, &value);
  wrong += value != (ranks - 1) - ((ranks - 1) % 2 != rank % 2);
  cw_team_join(all, &part);
  return wrong + (part != NULL);
}

// Ranks 2 and 3 of four have found something else.
static int be_one_of_two_kinds(int argc, char **argv) {
  CwTeam *all;
  begin_as_rank(&argc, &argv, &all);
  int rank = cw_team_rank(all);
  cw_log_open("test", NULL, rank == 0, 0, &test_log);
  return cw_mpi_fail(test_log, cw_team_alike(all, "planes", rank >= 2 ? 8 : 7));
}

static int be_a_rank(int argc, char **argv) {
  CwTeam *all;
  if (!strcmp(argv[1], "differ")) return be_one_of_two_kinds(argc, argv);
  cw_mpi_start(&argc, &argv, &all); // without a watch: all ranks agree first
  int rank = cw_team_rank(all);
  cw_log_open("test", NULL, rank == 0, 0, &test_log);
  CwStatus status = cw_team_agree(all, fail_where(argv[1], rank));
  if (status != CW_OK) return cw_mpi_fail(test_log, status);
  int wrong = spread_wrong(all) + gather_wrong(all) + split_wrong(all) + (cw_mpi_ranks() != cw_team_ranks(all));
  wrong += cw_team_alike(all, "numbers", UINT64_MAX) != CW_OK || cw_team_alike(all, "numbers", 7) != CW_OK;
  printf("RANK %d WRONG %d\n", rank, wrong);
  cw_log_close(&test_log);
  cw_mpi_end(&all);
  return wrong != 0;
}

static void ranks_spread_and_split(void **state) {
  for (int ranks = 1; ranks <= 5; ranks += 2) {
    launch_and_find_right(ranks, "spread", 1);
  }
}

static void the_first_that_fails_says_so(void **state) {
  assert_int_equal(launch(3, "disagree"), CW_ERR_INPUT);
  assert_int_equal(count_lines_with("error:"), 1);
  assert_non_null(strstr(output, "error: rank 1 has no case file"));
}

static void ranks_that_differ_are_named(void **state) {
  assert_int_equal(launch(4, "differ"), CW_ERR_LIBRARY);
  assert_int_equal(count_lines_with("error:"), 1);
  assert_non_null(strstr(output, "error: planes of rank 2 on "));
  assert_non_null(strstr(output, " are not those of rank 0 on "));
  assert_non_null(strstr(output, "; so it is with 2 of 4 ranks; "));
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  const struct CMUnitTest tests[] = {cmocka_unit_test(ranks_spread_and_split),
                                     cmocka_unit_test(the_first_that_fails_says_so),
                                     cmocka_unit_test(ranks_that_differ_are_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
