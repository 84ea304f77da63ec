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
#include "pipeline/parallel/message.h"
#include "pipeline/stop_line.h"

// Bytes in one message to all, and of all ranks at once to all, which have come before a rank that waits for them falls
// asleep: who sleeps hands nothing on.
static const int64_t TO_ALL = 1 << 20, AT_ONCE = 1 << 24;
enum { LOOKS = 20 }; // for a message before the first sleep: some microseconds, less than the sleep itself
// That a rank looks before it sleeps, s, where each has a core of its own: steps of all ranks follow one another in
// milliseconds, and who sleeps through the end of a wait is late by up to a third of it.
static const double LOOK_SECONDS = 2e-2;
// Who looks on and is so much later, s, than its processor time tells, found the core with another program: for a while
// no rank that waits here looks on, s.
static const double LATE = 1e-3, CROWDED = 1;
// One a process, as MPI is: whether its host has a core for each rank, and until when it is known to be taken by
// others.
static int own_core;
static double crowded_until;

static const double LEAST_PAUSE = 2e-5, MOST_PAUSE = 2e-3, PAUSE_GROWTH = 1.5; // s
static const double END_SECONDS = 5; // that a rank which has failed leaves to the one that says why

static const CwTeam ALONE = {.rank = 0, .ranks = 1};

const CwTeam *cw_team_of(const CwContext *context) {
  return context && context->team ? context->team : &ALONE;
}

static void fall_asleep(double seconds) {
  struct timespec pause = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
  nanosleep(&pause, NULL);
}

double cw_team_thread_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

CwTeamWait cw_team_wait_begin(void) {
  double now = cw_seconds();
  return (CwTeamWait){.pause = LEAST_PAUSE,
                      .until = own_core ? now + LOOK_SECONDS : 0,
                      .seen = now,
                      .since = now,
                      .used = cw_team_thread_seconds()};
}

// Whether another program had the core since the last look. A look may take long of itself: it moves what has come.
static int lost_core(CwTeamWait *wait, double now) {
  if (now - wait->seen <= LATE) return 0;
  double used = cw_team_thread_seconds(), lost = (now - wait->since) - (used - wait->used);
  wait->since = now;
  wait->used = used;
  return lost > LATE;
}

void cw_team_wait_on(CwTeamWait *wait) {
  double now = cw_seconds();
  if (now < wait->until && lost_core(wait, now)) crowded_until = now + CROWDED;
  wait->seen = now;
  if (wait->looks++ < LOOKS || (now < wait->until && now >= crowded_until)) return;
  fall_asleep(wait->pause);
  if (wait->pause < MOST_PAUSE) wait->pause *= PAUSE_GROWTH;
  wait->seen = wait->since = cw_seconds();
  wait->used = cw_team_thread_seconds();
}

void cw_team_wait(MPI_Request *request) {
  CwTeamWait wait = cw_team_wait_begin();
  for (int done = 0; MPI_Test(request, &done, MPI_STATUS_IGNORE), !done;) cw_team_wait_on(&wait);
}

void cw_team_barrier(const CwTeam *team) {
  MPI_Request request;
  if (team->ranks == 1) return;
  MPI_Ibarrier(team->comm, &request);
  cw_team_wait(&request);
}

static CwStatus make_team(MPI_Comm comm, int threads, CwTeam **made) {
  CwStatus status = CW_OK;
  CW_NEW(*made, 1);
  (*made)->threads = threads;
  (*made)->comm = comm;
  MPI_Comm_rank(comm, &(*made)->rank);
  MPI_Comm_size(comm, &(*made)->ranks);
done:
  return status;
}

// The ranks by host, and the cores that each may run on.
static CwStatus find_hosts(CwTeam *all) {
  CwStatus status = CW_OK;
  MPI_Comm host, firsts;
  cpu_set_t own;
  MPI_Comm_split_type(all->comm, MPI_COMM_TYPE_SHARED, all->rank, MPI_INFO_NULL, &host);
  CW_TRY(make_team(host, all->threads, &all->host));
  own_core = all->host->ranks <= sysconf(_SC_NPROCESSORS_ONLN);
  CW_NEW(all->host_of, all->ranks);
  CW_NEW(all->cores, all->ranks);
  int first = all->rank;
  MPI_Bcast(&first, 1, MPI_INT, 0, host);
  MPI_Allgather(&first, 1, MPI_INT, all->host_of, 1, MPI_INT, all->comm);
  for (int rank = 0; rank < all->ranks; rank++) all->hosts += all->host_of[rank] == rank;
  MPI_Comm_split(all->comm, first == all->rank ? 0 : MPI_UNDEFINED, all->rank, &firsts);
  if (first == all->rank) CW_TRY(make_team(firsts, all->threads, &all->firsts));
  CPU_ZERO(&own);
  if (sched_getaffinity(0, sizeof own, &own)) CPU_ZERO(&own);
  MPI_Allgather(&own, sizeof own, MPI_BYTE, all->cores, sizeof own, MPI_BYTE, all->comm);
done:
  return status;
}

// NULL is fine.
static void free_team(CwTeam **team) {
  CwTeam *old = *team;
  if (!old) return;
  free_team(&old->host);
  free_team(&old->firsts);
  cw_threads_free(&old->pool);
  free(old->host_of);
  free(old->cores);
  free(old->slot_rank);
  if (old->comm != MPI_COMM_WORLD) MPI_Comm_free(&old->comm);
  free(old);
  *team = NULL;
}

CwStatus cw_mpi_start(int *argc, char ***argv, CwTeam **all) {
  CwStatus status = CW_OK;
  int given, started = 0;
  cw_mpi_settings();
  // Else Open MPI gives its core away at every look for a message where there are more ranks than cores, on a busy
  // machine for a tenth of a second each. Who waits here sleeps.
  setenv("OMPI_MCA_mpi_yield_when_idle", "0", 0);
  MPI_Initialized(&started);
  CW_REQUIRE(started || MPI_Init_thread(argc, argv, MPI_THREAD_MULTIPLE, &given) == MPI_SUCCESS, CW_ERR_LIBRARY,
             "MPI cannot be started; allowed: by itself, or under the mpirun of the MPI that it is built with");
  MPI_Query_thread(&given);
  CW_TRY(make_team(MPI_COMM_WORLD, given >= MPI_THREAD_MULTIPLE, all));
  CW_TRY(find_hosts(*all));
done:
  return status;
}

void cw_mpi_end(CwTeam **all) {
  if (!*all) return;
  cw_team_barrier(*all);
  free_team(all);
  MPI_Finalize();
}

int cw_team_rank(const CwTeam *team) {
  return team->rank;
}

int cw_team_ranks(const CwTeam *team) {
  return team->ranks;
}

CwStatus cw_team_agree(const CwTeam *team, CwStatus status) {
  int mine = status == CW_OK ? INT_MAX : team->rank, first = mine;
  if (team->ranks > 1) {
    MPI_Request request;
    MPI_Iallreduce(&mine, &first, 1, MPI_INT, MPI_MIN, team->comm, &request);
    cw_team_wait(&request);
  }
  if (first == mine) return status;
  fall_asleep(END_SECONDS);
  return CW_FAIL(CW_ERR_RANK, "rank %d failed", first);
}

int cw_mpi_ranks(void) {
  int started = 0, ended = 0, ranks = 1;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  if (started && !ended) MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

int cw_mpi_fail(CwLog *log, CwStatus status) {
  int first = cw_stop_claim(); // the others, stopped for this, are to say nothing
  if (cw_mpi_ranks() == 1) return cw_log_error(log, status);
  if (!first) fall_asleep(END_SECONDS);
  int code = cw_log_error(log, status);
  MPI_Abort(MPI_COMM_WORLD, code);
  _exit(code);
}

typedef struct {
  uint64_t digest;
  char host[64];
} RankDigest;

CwStatus cw_team_alike(const CwTeam *team, const char *what, uint64_t digest) {
  CwStatus status = CW_OK;
  uint64_t bounds[2] = {digest, ~digest};
  RankDigest own = {.digest = digest}, *of = NULL;
  int others = 0, first = 0;
  if (team->ranks == 1) goto done;
  MPI_Request request;
  MPI_Iallreduce(MPI_IN_PLACE, bounds, 2, MPI_UINT64_T, MPI_MAX, team->comm, &request);
  cw_team_wait(&request);
  if (bounds[0] == ~bounds[1]) goto done;
  CW_NEW(of, team->ranks);
  gethostname(own.host, sizeof own.host - 1);
  MPI_Allgather(&own, sizeof own, MPI_BYTE, of, sizeof own, MPI_BYTE, team->comm);
  for (int rank = team->ranks - 1; rank > 0; rank--) {
    if (of[rank].digest == of[0].digest) continue;
    others++;
    first = rank;
  }
  status = CW_FAIL(CW_ERR_LIBRARY,
                   "%s of rank %d on %s are not those of rank 0 on %s; so it is with %d of %d ranks; allowed: hosts "
                   "with one kind of processor and the same libraries; leave the others out",
                   what, first, of[first].host, of[0].host, others, team->ranks);
done:
  free(of);
  return status;
}

void cw_team_most(const CwTeam *team, int64_t count, double *value) {
  for (int64_t at = 0, part; at < count && team->ranks > 1; at += part) {
    MPI_Request request;
    part = cw_message_items(count - at, sizeof *value);
    MPI_Iallreduce(MPI_IN_PLACE, value + at, (int)part, MPI_DOUBLE, MPI_MAX, team->comm, &request);
    cw_team_wait(&request);
  }
}

void cw_team_broadcast(const CwTeam *team, void *bytes, int64_t size, int from) {
  for (int64_t at = 0, part; at < size && team->ranks > 1; at += part) {
    MPI_Request request;
    part = cw_message_items(size - at < TO_ALL ? size - at : TO_ALL, 1);
    MPI_Ibcast((char *)bytes + at, (int)part, MPI_BYTE, from, team->comm, &request);
    cw_team_wait(&request);
  }
}

CwStatus cw_team_gather(const CwTeam *team, const int64_t *size, void **all) {
  CwStatus status = CW_OK;
  char *round = NULL;
  int *part = NULL, *place = NULL, ranks = team->ranks;
  int64_t most = 0;
  if (ranks == 1) goto done;
  for (int rank = 0; rank < ranks; rank++) most = size[rank] > most ? size[rank] : most;
  int64_t width = cw_message_items(AT_ONCE / ranks, (size_t)ranks); // of each rank in one round
  if (width > most) width = most;
  CW_NEW(part, ranks);
  CW_NEW(place, ranks);
  CW_NEW_UNSET(round, width * ranks);
  for (int64_t at = 0; at < most; at += width) {
    MPI_Request request;
    int end = 0;
    for (int rank = 0; rank < ranks; rank++) {
      int64_t left = size[rank] > at ? size[rank] - at : 0;
      part[rank] = (int)(left < width ? left : width);
      place[rank] = end;
      end += part[rank];
    }
    MPI_Iallgatherv((char *)all[team->rank] + (part[team->rank] ? at : 0), part[team->rank], MPI_BYTE, round, part,
                    place, MPI_BYTE, team->comm, &request);
    cw_team_wait(&request);
    for (int rank = 0; rank < ranks; rank++) {
      if (rank != team->rank && part[rank]) memcpy((char *)all[rank] + at, round + place[rank], (size_t)part[rank]);
    }
  }
done:
  free(part);
  free(place);
  free(round);
  return status;
}

CwStatus cw_team_split(const CwTeam *team, int number, CwTeam **part) {
  MPI_Comm comm;
  cw_team_barrier(team);
  MPI_Comm_split(team->comm, number, team->rank, &comm);
  return make_team(comm, team->threads, part);
}

void cw_team_join(const CwTeam *team, CwTeam **part) {
  free_team(part);
  cw_team_barrier(team);
}
