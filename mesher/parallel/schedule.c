// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/schedule.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"

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
  MPI_Allreduce(MPI_IN_PLACE, size, count, MPI_INT64_T, MPI_MAX, cw_team()->comm);
  for (int rank = 0; rank < cw_team()->ranks; rank++) {
    int64_t total = 0, at = 0;
    for (int32_t task = 0; task < count; task++) {
      if (owner[task] == rank) total += size[task];
    }
    if (total == 0) continue;
    pack = malloc((size_t)total);
    CW_REQUIRE(pack, CW_ERR_MEMORY, "out of memory: %lld bytes of results", (long long)total);
    for (int32_t task = 0; rank == cw_team()->rank && task < count; task++) {
      if (owner[task] != rank || size[task] == 0) continue;
      memcpy(pack + at, bytes[task], (size_t)size[task]);
      at += size[task];
    }
    cw_team_broadcast(pack, total, rank);
    at = 0;
    for (int32_t task = 0; rank != cw_team()->rank && task < count; task++) {
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
  MPI_Aint bytes = cw_team()->rank == 0 ? schedule->count * (MPI_Aint)sizeof(int64_t) : 0;
  CW_REQUIRE(MPI_Win_allocate(bytes, sizeof(int64_t), MPI_INFO_NULL, cw_team()->comm, &marks->ended, &marks->window) ==
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
    cw_team_sleep(pause);
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
  cw_team_barrier(NULL);
  CW_TRY(make_marks(schedule, marks));
  if (cw_team()->rank == 0) {
    cw_team_add(CW_TEAM_NEXT, -cw_team_add(CW_TEAM_NEXT, 0));
    cw_team_add(CW_TEAM_DONE, -cw_team_add(CW_TEAM_DONE, 0));
  }
  cw_team_barrier(NULL);
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
    int64_t place = cw_team()->ranks > 1 ? cw_team_add(CW_TEAM_NEXT, 1) : finished;
    if (place >= schedule->count) break;
    int32_t task = order[place].task;
    void *result = NULL;
    int64_t result_size = 0;
    if (marks->window != MPI_WIN_NULL && schedule->after[task] >= 0) wait_for(marks, schedule->after[task]);
    double start = cw_processor_seconds();
    CW_TRY(schedule->run(schedule->context, task, &result, &result_size));
    time[task] = cw_processor_seconds() - start;
    *own += time[task];
    owner[task] = cw_team()->rank;
    if (bytes)
      bytes[task] = result;
    else
      free(result);
    if (size) size[task] = result_size;
    if (marks->window != MPI_WIN_NULL) mark_add(marks, task, 1);
    finished = cw_team()->ranks > 1 ? cw_team_add(CW_TEAM_DONE, 1) + 1 : finished + 1;
    if (schedule->unit) cw_progress(finished);
  }
done:
  return status;
}

static void show_progress(void) {
  cw_progress(cw_team_add(CW_TEAM_DONE, 0));
}

CwStatus cw_schedule_run(const CwSchedule *schedule, void **bytes, int64_t *size, double *seconds) {
  CwStatus status = CW_OK;
  Ordered *order = NULL;
  int32_t *owner = NULL;
  double *time = NULL, own = 0;
  Marks marks = {.window = MPI_WIN_NULL};
  int64_t gathered = 0;
  const char *part = cw_profiler_part("exchange");
  CW_NEW(order, schedule->count);
  CW_NEW(owner, schedule->count);
  CW_NEW(time, schedule->count);
  for (int32_t task = 0; task < schedule->count; task++) owner[task] = -1;
  CW_TRY(put_in_order(schedule, order));
  if (cw_team()->ranks > 1) CW_TRY(start_counters(schedule, &marks));
  if (schedule->unit) cw_progress_start(schedule->step, schedule->count, schedule->unit);
  CW_TRY(take_tasks(schedule, order, &marks, bytes, size, owner, time, &own));
  if (cw_team()->ranks > 1) {
    cw_team_barrier(cw_team()->rank == 0 && schedule->unit ? show_progress : NULL);
    free_marks(&marks);
    MPI_Allreduce(MPI_IN_PLACE, owner, schedule->count, MPI_INT32_T, MPI_MAX, cw_team()->comm);
    MPI_Allreduce(MPI_IN_PLACE, time, schedule->count, MPI_DOUBLE, MPI_MAX, cw_team()->comm);
    if (schedule->gather) CW_TRY(gather_results(schedule->count, owner, bytes, size));
  }
  for (int32_t task = 0; schedule->gather && task < schedule->count; task++) gathered += size[task];
  CW_TRY(cw_profiler_tasks(schedule->step, schedule->count, schedule->cost, schedule->after, time, own, gathered));
  if (seconds) memcpy(seconds, time, (size_t)schedule->count * sizeof *time);
  if (schedule->unit) cw_progress_end();
  cw_profiler_part(part);
done:
  free(time);
  free(owner);
  free(order);
  if (status != CW_OK && cw_mpi_ranks() > 1) cw_mpi_fail(status);
  return status;
}
