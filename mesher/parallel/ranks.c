// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/ranks.h"

#include <stdint.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "mesher/parallel/team.h"
#include "pipeline/log.h"
#include "pipeline/mpi_settings.h"
#include "pipeline/stop_line.h"

enum { CHUNK = 1 << 26 }; // bytes of one broadcast: counts of MPI are int

// As MPI itself, once per process. The counters of a team stand on its first rank; all its ranks add to them without
// help of that one.
static struct {
  int rank, ranks;
  MPI_Win window;
  int64_t *slot;
} world = {.rank = 0, .ranks = 1};

// The ranks that work together now.
static CwTeam team = {.rank = 0, .ranks = 1};

const CwTeam *cw_team(void) {
  return &team;
}

static int64_t add_on(int rank, int slot, int64_t amount) {
  int64_t before = 0;
  MPI_Fetch_and_op(&amount, &before, MPI_INT64_T, rank, slot, MPI_SUM, world.window);
  MPI_Win_flush(rank, world.window);
  return before;
}

int64_t cw_team_add(CwTeamCounter counter, int64_t amount) {
  return add_on(team.first, counter, amount);
}

static void join_all(void) {
  team.rank = world.rank;
  team.ranks = world.ranks;
  team.first = 0;
  team.comm = MPI_COMM_WORLD;
}

void cw_team_sleep(double seconds) {
  struct timespec pause = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
  nanosleep(&pause, NULL);
}

void cw_team_barrier(void (*meanwhile)(void)) {
  MPI_Request request;
  int done = 0;
  double pause = 2e-5;
  MPI_Ibarrier(team.comm, &request);
  for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); !done; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) {
    cw_team_sleep(pause);
    if (pause < 2e-3) pause *= 1.5;
    if (meanwhile) meanwhile();
  }
}

CwStatus cw_mpi_start(int *argc, char ***argv, int *rank, int *ranks) {
  CwStatus status = CW_OK;
  int given;
  cw_mpi_settings();
  CW_REQUIRE(MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &given) == MPI_SUCCESS, CW_ERR_LIBRARY,
             "MPI cannot be started");
  MPI_Comm_rank(MPI_COMM_WORLD, &world.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &world.ranks);
  join_all();
  if (world.ranks > 1) {
    MPI_Aint bytes = CW_TEAM_COUNTERS * (MPI_Aint)sizeof(int64_t);
    CW_REQUIRE(MPI_Win_allocate(bytes, sizeof(int64_t), MPI_INFO_NULL, MPI_COMM_WORLD, &world.slot, &world.window) ==
                   MPI_SUCCESS,
               CW_ERR_LIBRARY, "MPI gives no shared counter");
    memset(world.slot, 0, (size_t)bytes);
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(MPI_MODE_NOCHECK, world.window);
  }
done:
  *rank = world.rank;
  *ranks = world.ranks;
  return status;
}

void cw_mpi_end(void) {
  int started = 0;
  MPI_Initialized(&started);
  if (!started) return;
  if (world.ranks > 1) {
    cw_team_barrier(NULL);
    MPI_Win_unlock_all(world.window);
    MPI_Win_free(&world.window);
  }
  MPI_Finalize();
  world.rank = 0;
  world.ranks = 1;
  join_all();
}

int cw_mpi_fail(CwStatus status) {
  cw_stop_claim(); // the others, stopped for this, are to say nothing
  if (world.ranks == 1) return cw_log_error(status);
  // The second to fail leaves the line to the first, and time to print it.
  if (add_on(0, CW_TEAM_FAILED, 1) > 0) cw_team_sleep(5.0);
  int code = cw_log_error(status);
  MPI_Abort(MPI_COMM_WORLD, code);
  _exit(code);
}

void cw_mpi_most(int32_t count, double *value) {
  if (world.ranks > 1) MPI_Allreduce(MPI_IN_PLACE, value, count, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

void cw_team_broadcast(void *bytes, int64_t size, int owner) {
  for (int64_t at = 0; at < size; at += CHUNK) {
    int64_t left = size - at;
    MPI_Bcast((char *)bytes + at, (int)(left < CHUNK ? left : CHUNK), MPI_BYTE, owner, team.comm);
  }
}

void cw_mpi_split(int number) {
  cw_team_barrier(NULL);
  MPI_Comm_split(MPI_COMM_WORLD, number, world.rank, &team.comm);
  MPI_Comm_rank(team.comm, &team.rank);
  MPI_Comm_size(team.comm, &team.ranks);
  team.first = world.rank;
  MPI_Bcast(&team.first, 1, MPI_INT, 0, team.comm);
}

void cw_mpi_join(void) {
  MPI_Comm_free(&team.comm);
  join_all();
  cw_team_barrier(NULL);
}

int cw_mpi_rank(void) {
  return world.rank;
}

int cw_mpi_ranks(void) {
  return world.ranks;
}

void cw_mpi_broadcast(void *bytes, int64_t size, int from) {
  if (world.ranks > 1) cw_team_broadcast(bytes, size, from);
}
