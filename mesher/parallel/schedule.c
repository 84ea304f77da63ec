// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/schedule.h"

#include <mpi.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "mesher/parallel/ledger.h"
#include "pipeline/log.h"
#include "pipeline/mpi_settings.h"
#include "pipeline/stop_line.h"

enum { SLOT_NEXT, SLOT_DONE, SLOT_FAILED, SLOT_COUNT };
enum { CHUNK = 1 << 26 }; // bytes of one broadcast: counts of MPI are int

// As MPI itself, once per process. The counters of a team stand on its first rank; all its ranks add to them without
// help of that one.
static struct {
  int rank, ranks;
  MPI_Win window;
  int64_t *slot;
} world = {.rank = 0, .ranks = 1};

// The ranks that work together now.
static struct {
  int rank, ranks, first; // first: its first rank's number among all
  MPI_Comm comm;
} team = {.rank = 0, .ranks = 1};

static int64_t add_on(int rank, int slot, int64_t amount) {
  int64_t before = 0;
  MPI_Fetch_and_op(&amount, &before, MPI_INT64_T, rank, slot, MPI_SUM, world.window);
  MPI_Win_flush(rank, world.window);
  return before;
}

static int64_t counter_add(int slot, int64_t amount) {
  return add_on(team.first, slot, amount);
}

static void join_all(void) {
  team.rank = world.rank;
  team.ranks = world.ranks;
  team.first = 0;
  team.comm = MPI_COMM_WORLD;
}

static void sleep_seconds(double seconds) {
  struct timespec pause = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
  nanosleep(&pause, NULL);
}

// A barrier that sleeps: the blocking one keeps its core busy, which another rank may need.
static void quiet_barrier(int progress) {
  MPI_Request request;
  int done = 0;
  double pause = 2e-5;
  MPI_Ibarrier(team.comm, &request);
  for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); !done; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) {
    sleep_seconds(pause);
    if (pause < 2e-3) pause *= 1.5;
    if (progress) cw_progress(counter_add(SLOT_DONE, 0));
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
    MPI_Aint bytes = SLOT_COUNT * (MPI_Aint)sizeof(int64_t);
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
    quiet_barrier(0);
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
  if (add_on(0, SLOT_FAILED, 1) > 0) sleep_seconds(5.0);
  int code = cw_log_error(status);
  MPI_Abort(MPI_COMM_WORLD, code);
  _exit(code);
}

void cw_mpi_most(int32_t count, double *value) {
  if (world.ranks > 1) MPI_Allreduce(MPI_IN_PLACE, value, count, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

static void broadcast(void *bytes, int64_t size, int owner) {
  for (int64_t at = 0; at < size; at += CHUNK) {
    int64_t left = size - at;
    MPI_Bcast((char *)bytes + at, (int)(left < CHUNK ? left : CHUNK), MPI_BYTE, owner, team.comm);
  }
}

void cw_mpi_split(int number) {
  quiet_barrier(0);
  MPI_Comm_split(MPI_COMM_WORLD, number, world.rank, &team.comm);
  MPI_Comm_rank(team.comm, &team.rank);
  MPI_Comm_size(team.comm, &team.ranks);
  team.first = world.rank;
  MPI_Bcast(&team.first, 1, MPI_INT, 0, team.comm);
}

void cw_mpi_join(void) {
  MPI_Comm_free(&team.comm);
  join_all();
  quiet_barrier(0);
}

int cw_mpi_rank(void) {
  return world.rank;
}

int cw_mpi_ranks(void) {
  return world.ranks;
}

void cw_mpi_broadcast(void *bytes, int64_t size, int from) {
  if (world.ranks > 1) broadcast(bytes, size, from);
}

typedef struct {
  double cost;
  int32_t task;
} Ordered;

static int compare_cost(const void *left, const void *right) {
  const Ordered *a = left, *b = right;
  if (a->cost != b->cost) return a->cost > b->cost ? -1 : 1;
  return a->task < b->task ? -1 : 1;
}

// Every rank gets every result. The results of one rank go as one message: thousands of small tasks, few
// broadcasts.
static CwStatus gather_results(int32_t count, const int32_t *owner, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  char *pack = NULL;
  MPI_Allreduce(MPI_IN_PLACE, size, count, MPI_INT64_T, MPI_MAX, team.comm);
  for (int rank = 0; rank < team.ranks; rank++) {
    int64_t total = 0, at = 0;
    for (int32_t task = 0; task < count; task++) {
      if (owner[task] == rank) total += size[task];
    }
    if (total == 0) continue;
    pack = malloc((size_t)total);
    CW_REQUIRE(pack, CW_ERR_MEMORY, "out of memory: %lld bytes of results", (long long)total);
    for (int32_t task = 0; rank == team.rank && task < count; task++) {
      if (owner[task] != rank || size[task] == 0) continue;
      memcpy(pack + at, bytes[task], (size_t)size[task]);
      at += size[task];
    }
    broadcast(pack, total, rank);
    at = 0;
    for (int32_t task = 0; rank != team.rank && task < count; task++) {
      if (owner[task] != rank || size[task] == 0) continue;
      bytes[task] = malloc((size_t)size[task]);
      CW_REQUIRE(bytes[task], CW_ERR_MEMORY, "out of memory: result of %lld bytes", (long long)size[task]);
      memcpy(bytes[task], pack + at, (size_t)size[task]);
      at += size[task];
    }
    free(pack);
    pack = NULL;
  }
done:
  free(pack);
  return status;
}

// Which tasks have ended, on the first rank of the team, where tasks wait for others.
typedef struct {
  MPI_Win window; // MPI_WIN_NULL: one rank, or no task waits
  int64_t *ended;
} Marks;

static CwStatus make_marks(const CwSchedule *schedule, Marks *marks) {
  CwStatus status = CW_OK;
  if (!schedule->after) goto done;
  MPI_Aint bytes = team.rank == 0 ? schedule->count * (MPI_Aint)sizeof(int64_t) : 0;
  CW_REQUIRE(MPI_Win_allocate(bytes, sizeof(int64_t), MPI_INFO_NULL, team.comm, &marks->ended, &marks->window) ==
                 MPI_SUCCESS,
             CW_ERR_LIBRARY, "MPI gives no shared marks");
  if (bytes) memset(marks->ended, 0, (size_t)bytes);
  MPI_Win_lock_all(MPI_MODE_NOCHECK, marks->window); // nobody looks before the next barrier
done:
  return status;
}

static int64_t mark_add(const Marks *marks, int32_t task, int64_t amount) {
  int64_t before = 0;
  MPI_Fetch_and_op(&amount, &before, MPI_INT64_T, 0, task, MPI_SUM, marks->window);
  MPI_Win_flush(0, marks->window);
  return before;
}

// Another rank has taken the task before, or this one has ended it: so the wait ends.
static void wait_for(const Marks *marks, int32_t task) {
  for (double pause = 2e-5; mark_add(marks, task, 0) == 0; pause = pause < 2e-3 ? 1.5 * pause : pause) {
    sleep_seconds(pause);
  }
}

static void free_marks(Marks *marks) {
  if (marks->window == MPI_WIN_NULL) return;
  MPI_Win_unlock_all(marks->window);
  MPI_Win_free(&marks->window);
}

// Puts the tasks in the order in which they are taken. CW_ERR_INPUT where one waits for another that comes later.
static CwStatus put_in_order(const CwSchedule *schedule, Ordered *order) {
  CwStatus status = CW_OK;
  for (int32_t task = 0; task < schedule->count; task++) {
    order[task] = (Ordered){schedule->cost ? schedule->cost[task] : 0.0, task};
    int32_t before = schedule->after ? schedule->after[task] : -1;
    CW_REQUIRE(before < 0 || (before < task && order[before].cost >= order[task].cost), CW_ERR_INPUT,
               "%s: task %d waits for task %d, which is taken later", schedule->step, task, before);
  }
  qsort(order, (size_t)schedule->count, sizeof *order, compare_cost);
done:
  return status;
}

// All counters at their beginning, on all ranks.
static CwStatus start_counters(const CwSchedule *schedule, Marks *marks) {
  CwStatus status = CW_OK;
  // All have left the last run before the counters start again, and none starts before they have.
  quiet_barrier(0);
  CW_TRY(make_marks(schedule, marks));
  if (team.rank == 0) {
    counter_add(SLOT_NEXT, -counter_add(SLOT_NEXT, 0));
    counter_add(SLOT_DONE, -counter_add(SLOT_DONE, 0));
  }
  quiet_barrier(0);
done:
  return status;
}

// Takes tasks as long as there are any. Of each that this rank took: its results, its owner (this rank), its time;
// *own: the sum of these times.
static CwStatus take_tasks(const CwSchedule *schedule, const Ordered *order, const Marks *marks, void **bytes,
                           int64_t *size, int32_t *owner, double *time, double *own) {
  CwStatus status = CW_OK;
  int64_t finished = 0;
  for (;;) {
    int64_t place = team.ranks > 1 ? counter_add(SLOT_NEXT, 1) : finished;
    if (place >= schedule->count) break;
    int32_t task = order[place].task;
    void *result = NULL;
    int64_t result_size = 0;
    if (marks->window != MPI_WIN_NULL && schedule->after[task] >= 0) wait_for(marks, schedule->after[task]);
    double start = cw_processor_seconds();
    CW_TRY(schedule->run(schedule->context, task, &result, &result_size));
    time[task] = cw_processor_seconds() - start;
    *own += time[task];
    owner[task] = team.rank;
    if (bytes)
      bytes[task] = result;
    else
      free(result);
    if (size) size[task] = result_size;
    if (marks->window != MPI_WIN_NULL) mark_add(marks, task, 1);
    finished = team.ranks > 1 ? counter_add(SLOT_DONE, 1) + 1 : finished + 1;
    if (schedule->unit) cw_progress(finished);
  }
done:
  return status;
}

CwStatus cw_schedule_run(const CwSchedule *schedule, void **bytes, int64_t *size, double *seconds) {
  CwStatus status = CW_OK;
  Ordered *order = NULL;
  int32_t *owner = NULL;
  double *time = NULL, own = 0;
  Marks marks = {.window = MPI_WIN_NULL};
  int64_t gathered = 0;
  const char *part = cw_ledger_part("exchange");
  CW_NEW(order, schedule->count);
  CW_NEW(owner, schedule->count);
  CW_NEW(time, schedule->count);
  for (int32_t task = 0; task < schedule->count; task++) owner[task] = -1;
  CW_TRY(put_in_order(schedule, order));
  if (team.ranks > 1) CW_TRY(start_counters(schedule, &marks));
  if (schedule->unit) cw_progress_start(schedule->step, schedule->count, schedule->unit);
  CW_TRY(take_tasks(schedule, order, &marks, bytes, size, owner, time, &own));
  if (team.ranks > 1) {
    quiet_barrier(team.rank == 0 && schedule->unit);
    free_marks(&marks);
    MPI_Allreduce(MPI_IN_PLACE, owner, schedule->count, MPI_INT32_T, MPI_MAX, team.comm);
    MPI_Allreduce(MPI_IN_PLACE, time, schedule->count, MPI_DOUBLE, MPI_MAX, team.comm);
    if (schedule->gather) CW_TRY(gather_results(schedule->count, owner, bytes, size));
  }
  for (int32_t task = 0; schedule->gather && task < schedule->count; task++) gathered += size[task];
  CW_TRY(cw_ledger_tasks(schedule->step, schedule->count, schedule->cost, schedule->after, time, own, gathered));
  if (seconds) memcpy(seconds, time, (size_t)schedule->count * sizeof *time);
  if (schedule->unit) cw_progress_end();
  cw_ledger_part(part);
done:
  free(time);
  free(owner);
  free(order);
  if (status != CW_OK && world.ranks > 1) cw_mpi_fail(status);
  return status;
}
