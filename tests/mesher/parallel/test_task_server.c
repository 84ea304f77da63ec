// SPDX-License-Identifier: AGPL-3.0-or-later
#include <unistd.h>
#include <mpi.h>

#include "launch.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/task_server.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static CwLog *test_log;

enum { PLACES = 1000, TAKEN = 900 };

static int64_t last_shown;

static void show(void *shown, int64_t ended) {
  *(int64_t *)shown = ended;
}

// Places of cost 1. Each is given once; all ranks learn of the end; what is given at a time is a quarter of a rank's
// part of what is left. `chain`: each place but the first waits for the one before it.
static int serve_places(const CwTeam *all, int chain, int *most) {
  static double left[PLACES + 1];
  static int32_t before[PLACES], given[PLACES];
  int wrong = 0, rank = cw_team_rank(all), ranks = cw_team_ranks(all);
  for (int32_t i = 0; i < PLACES; i++) {
    left[i] = PLACES - i;
    before[i] = i - 1;
    given[i] = 0;
  }
  CwTaskOrder order = {PLACES, left, chain ? before : NULL};
  CwTaskServer *server = NULL;
  if (cw_task_server_start(all, &order, &server) != CW_OK) return 1;
  *most = 0;
  for (;;) {
    CwPlaces places = cw_task_server_next(server, 0, show, &last_shown);
    if (places.count == 0) break;
    if (places.count > *most) *most = places.count;
    wrong += !chain && places.count > 1 && 4 * ranks * places.count > PLACES - places.first;
    for (int32_t i = 0; i < places.count; i++) given[places.first + i]++;
  }
  // Who was given the last of places that wait for none need not tell of their end.
  wrong += rank == 0 && (chain ? last_shown != PLACES : last_shown > PLACES);
  cw_task_server_stop(server);
  MPI_Allreduce(MPI_IN_PLACE, given, PLACES, MPI_INT32_T, MPI_SUM, MPI_COMM_WORLD);
  for (int32_t i = 0; i < PLACES; i++) wrong += given[i] != 1;
  return wrong;
}

// Of four places each waits for the one before it, and the second ends in vain: the third and the fourth are not given.
static int serve_in_vain(const CwTeam *all) {
  static double left[PLACES + 1];
  static int32_t before[PLACES], given[PLACES];
  int wrong = 0, in_vain = 0;
  for (int32_t i = 0; i < PLACES; i++) {
    left[i] = PLACES - i;
    before[i] = i % 4 ? i - 1 : -1;
    given[i] = 0;
  }
  CwTaskOrder order = {PLACES, left, before};
  CwTaskServer *server = NULL;
  if (cw_task_server_start(all, &order, &server) != CW_OK) return 1;
  for (;;) {
    CwPlaces places = cw_task_server_next(server, in_vain, NULL, NULL);
    if (places.count == 0) break;
    given[places.first]++;
    in_vain = places.first % 4 == 1;
  }
  cw_task_server_stop(server);
  MPI_Allreduce(MPI_IN_PLACE, given, PLACES, MPI_INT32_T, MPI_SUM, MPI_COMM_WORLD);
  for (int32_t i = 0; i < PLACES; i++) wrong += given[i] != (i % 4 < 2);
  return wrong;
}

// The first rank takes a place and works until the others have been given all that is left.
static int serve_while_at_work(const CwTeam *all) {
  static const double left[] = {4, 3, 2, 1, 0};
  CwTaskOrder order = {4, left, NULL};
  CwTaskServer *server = NULL;
  int taken = 0, sum = 0, others, rank = cw_team_rank(all), ranks = cw_team_ranks(all);
  if (cw_task_server_start(all, &order, &server) != CW_OK) return 1;
  if (rank > 0) MPI_Barrier(MPI_COMM_WORLD);
  for (;;) {
    CwPlaces places = cw_task_server_next(server, 0, NULL, NULL);
    if (places.count == 0) break;
    taken += places.count;
    if (rank > 0) MPI_Send(NULL, 0, MPI_BYTE, 0, TAKEN, MPI_COMM_WORLD);
    if (rank == 0 && taken == 1) {
      MPI_Barrier(MPI_COMM_WORLD);
      for (int told = 0, there; told < 3; told += there) {
        MPI_Iprobe(MPI_ANY_SOURCE, TAKEN, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
        if (there) MPI_Recv(NULL, 0, MPI_BYTE, MPI_ANY_SOURCE, TAKEN, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        usleep(1000);
      }
    }
  }
  cw_task_server_stop(server);
  MPI_Allreduce(&taken, &sum, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  others = rank == 0 ? sum - taken : 3;
  return (sum != 4) + (others != 3) + (ranks < 2);
}

static int be_a_rank(int argc, char **argv) {
  int most = 0, wrong = 0;
  CwTeam *all;
  begin_as_rank(&argc, &argv, &all);
  int rank = cw_team_rank(all), ranks = cw_team_ranks(all);
  cw_log_open("test", NULL, rank == 0, 0, &test_log);
  for (int repeat = 0; repeat < 3; repeat++) {
    wrong += serve_places(all, 0, &most);
    wrong += ranks == 1 && most != PLACES / 4;
    wrong += serve_places(all, 1, &most) + (most > 1);
    wrong += serve_in_vain(all);
  }
  if (ranks > 1) wrong += serve_while_at_work(all);
  printf("RANK %d WRONG %d\n", rank, wrong);
  cw_log_close(&test_log);
  return end_as_rank(all, wrong != 0);
}

static void each_place_is_given_once_and_at_once(void **state) {
  for (int ranks = 1; ranks <= 5; ranks++) {
    launch_and_find_right(ranks, "serve", 1);
  }
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  const struct CMUnitTest tests[] = {cmocka_unit_test(each_place_is_given_once_and_at_once)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
