// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/ranks.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "mesher/parallel/team.h"
#include "pipeline/log.h"
#include "pipeline/mpi_settings.h"
#include "pipeline/stop_line.h"

enum {
  CHUNK = 1 << 26, // bytes of one broadcast: counts of MPI are int
  LOOKS = 20       // for a message before the first sleep: some microseconds, less than the sleep itself
};

const double CW_TEAM_PAUSE = 2e-5;                         // s
static const double MOST_PAUSE = 2e-3, PAUSE_GROWTH = 1.5; // s
static const double END_SECONDS = 5; // that a rank which has failed leaves to the one that says why

// As MPI itself, once per process.
static struct { int rank, ranks; } world = {.rank = 0, .ranks = 1};

// The ranks that work together now.
static CwTeam team = {.rank = 0, .ranks = 1};

const CwTeam *cw_team(void) {
  return &team;
}

static void join_all(void) {
  team.rank = world.rank;
  team.ranks = world.ranks;
  team.comm = MPI_COMM_WORLD;
}

void cw_team_sleep(double seconds) {
  struct timespec pause = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
  nanosleep(&pause, NULL);
}

double cw_team_longer(double pause) {
  return pause < MOST_PAUSE ? PAUSE_GROWTH * pause : pause;
}

void cw_team_wait(MPI_Request *request) {
  int done = 0;
  double pause = CW_TEAM_PAUSE;
  for (int looks = 0; MPI_Test(request, &done, MPI_STATUS_IGNORE), !done; looks++) {
    if (looks < LOOKS) continue;
    cw_team_sleep(pause);
    pause = cw_team_longer(pause);
  }
}

void cw_team_barrier(void) {
  MPI_Request request;
  MPI_Ibarrier(team.comm, &request);
  cw_team_wait(&request);
}

CwStatus cw_mpi_start(int *argc, char ***argv, int *rank, int *ranks) {
  CwStatus status = CW_OK;
  int given, started = 0;
  cw_mpi_settings();
  // Else Open MPI gives its core away at every look for a message where there are more ranks than cores, on a busy
  // machine for a tenth of a second each. Who waits here sleeps.
  setenv("OMPI_MCA_mpi_yield_when_idle", "0", 0);
  MPI_Initialized(&started);
  CW_REQUIRE(started || MPI_Init_thread(argc, argv, MPI_THREAD_MULTIPLE, &given) == MPI_SUCCESS, CW_ERR_LIBRARY,
             "MPI cannot be started");
  MPI_Query_thread(&given);
  team.threads = given >= MPI_THREAD_MULTIPLE;
  MPI_Comm_rank(MPI_COMM_WORLD, &world.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &world.ranks);
  join_all();
done:
  *rank = world.rank;
  *ranks = world.ranks;
  return status;
}

void cw_mpi_end(void) {
  int started = 0;
  MPI_Initialized(&started);
  if (!started) return;
  if (world.ranks > 1) cw_team_barrier();
  MPI_Finalize();
  world.rank = 0;
  world.ranks = 1;
  join_all();
}

CwStatus cw_mpi_agree(CwStatus status) {
  int mine = status == CW_OK ? INT_MAX : world.rank, first = mine;
  if (world.ranks > 1) {
    MPI_Request request;
    MPI_Iallreduce(&mine, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD, &request);
    cw_team_wait(&request);
  }
  if (first == mine) return status;
  cw_team_sleep(END_SECONDS);
  return CW_FAIL(CW_ERR_RANK, "rank %d failed", first);
}

int cw_mpi_fail(CwStatus status) {
  int first = cw_stop_claim(); // the others, stopped for this, are to say nothing
  if (world.ranks == 1) return cw_log_error(status);
  if (!first) cw_team_sleep(END_SECONDS);
  int code = cw_log_error(status);
  MPI_Abort(MPI_COMM_WORLD, code);
  _exit(code);
}

void cw_team_most(int32_t count, double *value) {
  MPI_Request request;
  MPI_Iallreduce(MPI_IN_PLACE, value, count, MPI_DOUBLE, MPI_MAX, team.comm, &request);
  cw_team_wait(&request);
}

void cw_mpi_most(int32_t count, double *value) {
  if (world.ranks > 1) cw_team_most(count, value);
}

void cw_team_broadcast(void *bytes, int64_t size, int owner) {
  for (int64_t at = 0; at < size; at += CHUNK) {
    int64_t left = size - at;
    MPI_Request request;
    MPI_Ibcast((char *)bytes + at, (int)(left < CHUNK ? left : CHUNK), MPI_BYTE, owner, team.comm, &request);
    cw_team_wait(&request);
  }
}

void cw_mpi_split(int number) {
  cw_team_barrier();
  MPI_Comm_split(MPI_COMM_WORLD, number, world.rank, &team.comm);
  MPI_Comm_rank(team.comm, &team.rank);
  MPI_Comm_size(team.comm, &team.ranks);
}

void cw_mpi_join(void) {
  MPI_Comm_free(&team.comm);
  join_all();
  cw_team_barrier();
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
