// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/schedule.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/task_server.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"

typedef struct {
  double cost;
  int32_t task;
} Ordered;

static double cost_of(const CwSchedule *schedule, int32_t task) {
  return schedule->cost ? schedule->cost[task] : 1.0;
}

static int compare_cost(const void *left, const void *right) {
  const Ordered *a = left, *b = right;
  if (a->cost != b->cost) return a->cost > b->cost ? -1 : 1;
  return a->task < b->task ? -1 : 1;
}

// What is known of a task that has ended: numbers that all ranks get by one message, -1 until then.
typedef struct {
  double owner, size, seconds;
} TaskEnd;

// The results of a rank, one behind the other in `pack`; to: 1 into the pack, 0 out of it, where room is made for each.
static CwStatus move_results(int rank, int32_t count, const TaskEnd *end, int to, char *pack, void **bytes) {
  CwStatus status = CW_OK;
  for (int32_t task = 0; task < count; task++) {
    if (end[task].owner != rank || end[task].size == 0) continue;
    size_t size = (size_t)end[task].size;
    if (!to) bytes[task] = malloc(size);
    CW_REQUIRE(bytes[task], CW_ERR_MEMORY, "out of memory: result of %zu bytes", size);
    memcpy(to ? pack : bytes[task], to ? bytes[task] : pack, size);
    pack += size;
  }
done:
  return status;
}

// Every rank gets every result: thousands of small tasks, few messages.
static CwStatus gather_results(const CwTeam *team, int32_t count, const TaskEnd *end, void **bytes) {
  CwStatus status = CW_OK;
  int64_t *size = NULL;
  void **pack = NULL;
  CW_NEW(size, team->ranks);
  CW_NEW(pack, team->ranks);
  if (team->ranks == 1) goto done;
  for (int32_t task = 0; task < count; task++) size[(int)end[task].owner] += (int64_t)end[task].size;
  for (int rank = 0; rank < team->ranks; rank++) {
    pack[rank] = malloc((size_t)size[rank] + 1);
    CW_REQUIRE(pack[rank], CW_ERR_MEMORY, "out of memory: results of %lld bytes", (long long)size[rank]);
  }
  CW_TRY(move_results(team->rank, count, end, 1, pack[team->rank], bytes));
  CW_TRY(cw_team_gather(team, size, pack));
  for (int rank = 0; rank < team->ranks; rank++) {
    if (rank != team->rank) CW_TRY(move_results(rank, count, end, 0, pack[rank], bytes));
    free(pack[rank]);
    pack[rank] = NULL;
  }
done:
  for (int rank = 0; pack && rank < team->ranks; rank++) free(pack[rank]);
  free(pack);
  free(size);
  return status;
}

// The tasks in the order in which they are taken.
typedef struct {
  int32_t *task, *before; // by place; before: NULL where none waits
  double *left;
  Ordered *by_cost;
} Order;

static void free_order(Order *order) {
  free(order->task);
  free(order->before);
  free(order->left);
  free(order->by_cost);
}

// CW_ERR_INPUT where a task waits for another that comes later.
static CwStatus put_in_order(const CwSchedule *schedule, Order *order) {
  CwStatus status = CW_OK;
  int32_t count = schedule->count, *place = NULL;
  CW_NEW(order->by_cost, count);
  CW_NEW(order->task, count);
  CW_NEW(order->left, count + 1);
  CW_NEW(place, count);
  if (schedule->after) CW_NEW(order->before, count);
  for (int32_t task = 0; task < count; task++) order->by_cost[task] = (Ordered){cost_of(schedule, task), task};
  for (int32_t task = count; order->before && task-- > 0;) { // with all that waits for it
    if (schedule->after[task] >= 0) order->by_cost[schedule->after[task]].cost += order->by_cost[task].cost;
  }
  qsort(order->by_cost, (size_t)count, sizeof *order->by_cost, compare_cost);
  for (int32_t i = 0; i < count; i++) {
    order->task[i] = order->by_cost[i].task;
    place[order->task[i]] = i;
  }
  for (int32_t i = count; i-- > 0;) order->left[i] = order->left[i + 1] + cost_of(schedule, order->task[i]);
  for (int32_t i = 0; order->before && i < count; i++) {
    int32_t after = schedule->after[order->task[i]];
    order->before[i] = after < 0 ? -1 : place[after];
    CW_REQUIRE(order->before[i] < i, CW_ERR_INPUT, "%s: task %d waits for task %d, which is taken later",
               schedule->step, order->task[i], after);
  }
done:
  free(place);
  return status;
}

typedef struct {
  const CwTeam *team;
  CwLog *log;
  const CwSchedule *schedule;
  void **bytes;
  TaskEnd *end;   // by task
  double seconds; // of this rank's tasks
} Work;

static CwStatus run_task(Work *work, int32_t task) {
  CwStatus status = CW_OK;
  void *result = NULL;
  int64_t size = 0;
  double start = cw_processor_seconds();
  CW_TRY(work->schedule->run(work->schedule->context, task, &result, &size));
  double seconds = cw_processor_seconds() - start;
  work->seconds += seconds;
  work->end[task] = (TaskEnd){work->team->rank, (double)size, seconds};
  if (work->bytes)
    work->bytes[task] = result;
  else
    free(result);
done:
  return status;
}

static void show_progress(void *log, int64_t ended) {
  cw_progress(log, ended);
}

// Each rank takes what is next when it is free.
static CwStatus take_tasks(Work *work, const Order *order) {
  CwStatus status = CW_OK;
  CwTaskServer *server = NULL;
  CwTaskOrder list = {work->schedule->count, order->left, order->before};
  CW_TRY(cw_task_server_start(work->team, &list, &server));
  for (;;) {
    CwPlaces places = cw_task_server_next(server, work->schedule->unit ? show_progress : NULL, work->log);
    if (places.count == 0) break;
    for (int32_t i = 0; i < places.count; i++) {
      cw_task_server_look(server, &places, i);
      CW_TRY(run_task(work, order->task[places.first + i]));
    }
  }
  cw_task_server_stop(server);
done:
  return status;
}

// Tasks in turn to each rank; one that waits for another, to the rank of that.
static CwStatus deal_tasks(Work *work, const Order *order) {
  CwStatus status = CW_OK;
  for (int32_t place = 0, ended = 0; place < work->schedule->count; place++) {
    int32_t first = place;
    while (order->before && order->before[first] >= 0) first = order->before[first];
    if (first % work->team->ranks != work->team->rank) continue;
    CW_TRY(run_task(work, order->task[place]));
    if (work->schedule->unit) cw_progress(work->log, ++ended * work->team->ranks);
  }
  cw_team_barrier(work->team);
done:
  return status;
}

CwStatus cw_schedule_run(const CwContext *context, const CwSchedule *schedule, void **bytes, int64_t *size,
                         double *seconds) {
  CwStatus status = CW_OK;
  Order order = {0};
  Work work = {.team = cw_team_of(context), .log = cw_log_of(context), .schedule = schedule, .bytes = bytes};
  int32_t count = schedule->count;
  int64_t gathered = 0;
  double *time = NULL;
  const char *part = cw_profiler_part(context, "exchange");
  CW_NEW(work.end, count);
  CW_NEW(time, count);
  for (int32_t task = 0; task < count; task++) work.end[task] = (TaskEnd){-1, -1, -1};
  CW_TRY(put_in_order(schedule, &order));
  if (schedule->unit) cw_progress_start(work.log, schedule->step, count, schedule->unit);
  int served = work.team->ranks > 1 && work.team->threads && count > 0 && !schedule->alike;
  CW_TRY(served ? take_tasks(&work, &order) : deal_tasks(&work, &order));
  cw_team_most(work.team, (int64_t)3 * count, &work.end->owner);
  for (int32_t task = 0; task < count; task++) {
    time[task] = work.end[task].seconds;
    if (size) size[task] = (int64_t)work.end[task].size;
    if (schedule->gather) gathered += size[task];
  }
  if (schedule->gather) CW_TRY(gather_results(work.team, count, work.end, bytes));
  CW_TRY(
      cw_profiler_tasks(context, schedule->step, count, schedule->cost, schedule->after, time, work.seconds, gathered));
  if (seconds) memcpy(seconds, time, (size_t)count * sizeof *time);
  if (schedule->unit) {
    cw_progress(work.log, count);
    cw_progress_end(work.log);
  }
  cw_profiler_part(context, part);
done:
  free(time);
  free(work.end);
  free_order(&order);
  if (status != CW_OK && cw_mpi_ranks() > 1) cw_mpi_fail(cw_log_of(context), status);
  return status;
}
