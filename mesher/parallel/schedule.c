// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/schedule.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/task_server.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"

static const int64_t SHARED_LEAST = 1 << 20; // bytes of results that are worth memory of their own

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
  for (int rank = 0; rank < team->ranks; rank++) CW_NEW_UNSET(pack[rank], size[rank]);
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

static int64_t padded(const TaskEnd *end) {
  return ((int64_t)end->size + 15) / 16 * 16;
}

// Where the results of each rank lie, those of a host together.
typedef struct {
  int64_t *size, *end;      // of each rank: bytes; where they end, once all are placed
  int64_t *of_host, *begin; // of each host: bytes; where they begin
  int64_t all;
} Places;

static CwStatus place_results(const CwTeam *team, int32_t count, const TaskEnd *end, Places *places) {
  CwStatus status = CW_OK;
  int hosts = 0;
  CW_NEW(places->size, team->ranks);
  CW_NEW(places->end, team->ranks);
  CW_NEW(places->of_host, team->hosts);
  CW_NEW(places->begin, team->hosts);
  for (int32_t task = 0; task < count; task++) places->size[(int)end[task].owner] += padded(&end[task]);
  for (int first = 0; first < team->ranks; first++) {
    if (team->host_of[first] != first) continue;
    places->begin[hosts] = places->all;
    for (int rank = first; rank < team->ranks; rank++) {
      if (team->host_of[rank] != first) continue;
      places->end[rank] = places->all;
      places->all += places->size[rank];
    }
    places->of_host[hosts] = places->all - places->begin[hosts];
    hosts++;
  }
done:
  return status;
}

// The same into memory that the ranks of a host share.
static CwStatus share_results(const CwTeam *team, int32_t count, const TaskEnd *end, void **bytes,
                              CwHostMemory **held) {
  CwStatus status = CW_OK;
  Places places = {0};
  void **part = NULL;
  CW_NEW(part, team->hosts);
  CW_TRY(place_results(team, count, end, &places));
  CW_TRY(cw_host_memory_make(team->host, places.all, held));
  char *at = cw_host_memory_at(*held);
  for (int32_t task = 0; task < count; task++) {
    int owner = (int)end[task].owner;
    void *made = bytes[task];
    bytes[task] = end[task].size > 0 ? at + places.end[owner] : NULL;
    places.end[owner] += padded(&end[task]);
    if (owner != team->rank) continue;
    if (end[task].size > 0) memcpy(bytes[task], made, (size_t)end[task].size);
    free(made);
  }
  for (int rank = 0, on_host = 0; rank < team->ranks; rank++) {
    if (team->host_of[rank] != team->host_of[team->rank]) continue;
    cw_host_memory_spread(team->host, *held, places.end[rank] - places.size[rank], places.size[rank], on_host++);
  }
  if (team->hosts > 1) {
    for (int host = 0; host < team->hosts; host++) part[host] = at + places.begin[host];
    if (team->firsts) CW_TRY(cw_team_gather(team->firsts, places.of_host, part));
    cw_host_memory_spread(team->host, *held, 0, places.all, 0);
  }
  cw_host_memory_seal(*held);
done:
  free(places.size);
  free(places.end);
  free(places.of_host);
  free(places.begin);
  free(part);
  return status;
}

// The tasks in the order in which they are taken.
typedef struct {
  int32_t *task, *before; // by place; before: NULL where none waits
  double *left;
} Order;

static void free_order(Order *order) {
  free(order->task);
  free(order->before);
  free(order->left);
}

// CW_ERR_INPUT where a task waits for another that comes later.
static CwStatus put_in_order(const CwSchedule *schedule, Order *order) {
  CwStatus status = CW_OK;
  int32_t count = schedule->count, *place = NULL;
  Ordered *by_cost = NULL;
  CW_NEW(by_cost, count);
  CW_NEW(order->task, count);
  CW_NEW(order->left, count + 1);
  CW_NEW(place, count);
  if (schedule->after) CW_NEW(order->before, count);
  for (int32_t task = 0; task < count; task++) by_cost[task] = (Ordered){cost_of(schedule, task), task};
  for (int32_t task = count; order->before && task-- > 0;) { // with all that waits for it
    if (schedule->after[task] >= 0) by_cost[schedule->after[task]].cost += by_cost[task].cost;
  }
  qsort(by_cost, (size_t)count, sizeof *by_cost, compare_cost);
  for (int32_t i = 0; i < count; i++) {
    order->task[i] = by_cost[i].task;
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
  free(by_cost);
  return status;
}

typedef struct {
  const CwTeam *team;
  CwLog *log;
  const CwSchedule *schedule;
  void **bytes;
  TaskEnd *end;   // by task
  int32_t *dealt; // places of this rank
} Work;

static CwStatus run_task(Work *work, int32_t task) {
  CwStatus status = CW_OK;
  void *result = NULL;
  int64_t size = 0;
  double start = cw_team_thread_seconds();
  CW_TRY(work->schedule->run(work->schedule->context, task, &result, &size));
  double seconds = cw_team_thread_seconds() - start;
  work->end[task] = (TaskEnd){work->team->rank, (double)size, seconds};
  if (work->bytes)
    work->bytes[task] = result;
  else
    free(result);
done:
  return status;
}

// Whether those that wait for a task, which has ended on this rank, are left out.
static int was_in_vain(const Work *work, int32_t task) {
  const CwSchedule *schedule = work->schedule;
  return schedule->after && schedule->in_vain && schedule->in_vain(work->bytes[task]);
}

static void show_progress(void *log, int64_t ended) {
  cw_progress(log, ended);
}

// Each rank takes what is next when it is free.
static CwStatus take_tasks(Work *work, const Order *order) {
  CwStatus status = CW_OK;
  CwTaskServer *server = NULL;
  CwTaskOrder list = {work->schedule->count, order->left, order->before};
  int in_vain = 0;
  CW_TRY(cw_task_server_start(work->team, &list, &server));
  for (;;) {
    CwPlaces places = cw_task_server_next(server, in_vain, work->schedule->unit ? show_progress : NULL, work->log);
    if (places.count == 0) break;
    for (int32_t i = 0; i < places.count; i++) {
      cw_task_server_look(server, &places, i);
      CW_TRY(run_task(work, order->task[places.first + i]));
    }
    in_vain = was_in_vain(work, order->task[places.first]); // the one place, where tasks wait for others
  }
  cw_task_server_stop(server);
done:
  return status;
}

static CwStatus run_dealt(void *given, int32_t item) {
  Work *work = given;
  return run_task(work, work->dealt[item]);
}

static int rank_of_place(const CwTeam *team, int32_t place) {
  return team->slot_rank ? team->slot_rank[place % team->slots] : place % team->ranks;
}

// Whether the task that a task of this rank waits for was left out, or in vain.
static int is_left_out(const Work *work, int32_t task) {
  int32_t after = work->schedule->after ? work->schedule->after[task] : -1;
  return after >= 0 && (work->end[after].owner < 0 || was_in_vain(work, after));
}

// Tasks in turn to each rank; one that waits for another, to the rank of that.
static CwStatus deal_tasks(Work *work, const Order *order) {
  CwStatus status = CW_OK;
  int32_t count = 0;
  CW_REQUIRE(!work->team->pool || !order->before, CW_ERR_INPUT, "%s: threads take tasks that wait for none",
             work->schedule->step);
  CW_NEW_UNSET(work->dealt, work->schedule->count);
  for (int32_t place = 0; place < work->schedule->count; place++) {
    int32_t first = place;
    while (order->before && order->before[first] >= 0) first = order->before[first];
    if (rank_of_place(work->team, first) == work->team->rank) work->dealt[count++] = order->task[place];
  }
  if (work->team->pool) {
    CW_TRY(cw_threads_run(work->team->pool, count, run_dealt, work));
  } else {
    for (int32_t i = 0; i < count; i++) {
      if (!is_left_out(work, work->dealt[i])) CW_TRY(run_task(work, work->dealt[i]));
      if (work->schedule->unit) cw_progress(work->log, (i + 1) * work->team->ranks);
    }
  }
  cw_team_barrier(work->team);
done:
  free(work->dealt);
  return status;
}

CwStatus cw_schedule_run(const CwContext *context, const CwSchedule *schedule, void **bytes, int64_t *size,
                         double *seconds) {
  CwStatus status = CW_OK;
  Order order = {0};
  Work work = {.team = cw_team_of(context), .log = cw_log_of(context), .schedule = schedule, .bytes = bytes};
  int32_t count = schedule->count;
  int64_t gathered = 0;
  double *time = NULL, own = 0;
  const char *part = cw_profiler_part(context, "exchange");
  CW_NEW(work.end, count);
  CW_NEW(time, count);
  for (int32_t task = 0; task < count; task++) work.end[task] = (TaskEnd){-1, -1, -1};
  CW_TRY(put_in_order(schedule, &order));
  if (schedule->unit) cw_progress_start(work.log, schedule->step, count, schedule->unit);
  int with_threads = work.team->slots > work.team->ranks; // of any rank
  int served = work.team->ranks > 1 && work.team->threads && !with_threads && count > 0 && !schedule->alike;
  CW_TRY(served ? take_tasks(&work, &order) : deal_tasks(&work, &order));
  cw_team_most(work.team, (int64_t)3 * count, &work.end->owner);
  for (int32_t task = 0; task < count; task++) {
    if (work.end[task].owner < 0) work.end[task] = (TaskEnd){0}; // was left out
    time[task] = work.end[task].seconds;
    if (work.end[task].owner == work.team->rank) own += time[task];
    if (size) size[task] = (int64_t)work.end[task].size;
    if (schedule->gather) gathered += size[task];
  }
  // As all ranks find it: hosts of one rank and of several may be side by side.
  int shares = schedule->held && work.team->host && work.team->hosts < work.team->ranks && gathered >= SHARED_LEAST;
  if (schedule->held) *schedule->held = NULL;
  if (schedule->gather)
    CW_TRY(shares ? share_results(work.team, count, work.end, bytes, schedule->held)
                  : gather_results(work.team, count, work.end, bytes));
  CW_TRY(cw_profiler_tasks(context, schedule->step, count, schedule->cost, schedule->after, time, own, gathered));
  if (seconds) memcpy(seconds, time, (size_t)count * sizeof *time);
  if (schedule->unit) {
    cw_progress(work.log, count);
    cw_progress_end(work.log);
  }
  cw_profiler_part(context, part);
done:
  // Before anything is freed: the thread that serves tasks reads the order until the end.
  if (status != CW_OK && cw_mpi_ranks() > 1) cw_mpi_fail(cw_log_of(context), status);
  free(time);
  free(work.end);
  free_order(&order);
  return status;
}

CwStatus cw_schedule_gather(const CwContext *context, const CwSchedule *schedule, CwTaskResults *results) {
  CwStatus status = CW_OK;
  CwSchedule gathering = *schedule;
  gathering.gather = 1;
  results->count = schedule->count;
  CW_NEW(results->bytes, results->count);
  CW_NEW(results->size, results->count);
  CW_TRY(cw_schedule_run(context, &gathering, results->bytes, results->size, NULL));
done:
  return status;
}

void cw_task_results_free(CwTaskResults *results) {
  for (int32_t i = 0; results->bytes && i < results->count; i++) free(results->bytes[i]);
  free(results->bytes);
  free(results->size);
  *results = (CwTaskResults){0};
}

int64_t cw_task_results_join(const CwTaskResults *results, void *to) {
  int64_t all = 0;
  for (int32_t i = 0; i < results->count; i++) {
    if (to && results->size[i] > 0) memcpy((char *)to + all, results->bytes[i], (size_t)results->size[i]);
    all += results->size[i];
  }
  return all;
}
