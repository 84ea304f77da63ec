// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/profiler.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/ranks.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"
#include "pipeline/record.h"

enum { PARTS_MOST = 64 };

// What all ranks do together, or those of one item.
typedef struct {
  double cost;          // predicted, of an item
  int part_count, part; // the present one
  const char *name[PARTS_MOST];
  double spent[PARTS_MOST];
  json_t *tasks; // of each schedule, as cw_profiler_json gives them; "most": of this rank until then
  json_t *taken; // from the ranks of the item: holds the names
} Account;

// A step that went on side by side.
typedef struct {
  const char *step;
  double own;
  int least_ranks;
  int32_t count;
  Account *item;
} Sides;

struct CwProfiler {
  Account all, *present; // present: NULL is `all`
  double since;          // when the present part went on
  int32_t step_count, step_capacity;
  Sides *step;
};

CwStatus cw_profiler_make(CwProfiler **made) {
  CwStatus status = CW_OK;
  CW_NEW(*made, 1);
  (*made)->all = (Account){.part_count = 1, .name = {"start"}, .tasks = json_array()};
  (*made)->since = cw_processor_seconds();
done:
  return status;
}

static CwProfiler *profiler_of(const CwContext *context) {
  return context ? context->profiler : NULL;
}

static Account *present_account(CwProfiler *profiler) {
  return profiler->present ? profiler->present : &profiler->all;
}

static void close_part(CwProfiler *profiler) {
  Account *account = present_account(profiler);
  double now = cw_processor_seconds();
  account->spent[account->part] += now - profiler->since;
  profiler->since = now;
}

const char *cw_profiler_part(const CwContext *context, const char *part) {
  CwProfiler *profiler = profiler_of(context);
  if (!profiler) return "";
  Account *account = present_account(profiler);
  const char *before = account->name[account->part];
  close_part(profiler);
  int at = 0;
  while (at < account->part_count && strcmp(account->name[at], part)) at++;
  if (at == PARTS_MOST) at = 0;
  if (at == account->part_count) account->name[account->part_count++] = part;
  account->part = at;
  return before;
}

static json_t *rounded(double seconds) {
  return cw_json_number(round(seconds * 1e6) / 1e6);
}

static json_t *numbers(int32_t count, const double *value, int round_them) {
  json_t *array = json_array();
  for (int32_t i = 0; i < count; i++) {
    json_array_append_new(array, round_them ? rounded(value[i]) : cw_json_number(value[i]));
  }
  return array;
}

CwStatus cw_profiler_tasks(const CwContext *context, const char *step, int32_t count, const double *cost,
                           const int32_t *after, const double *seconds, double own, int64_t bytes) {
  CwStatus status = CW_OK;
  CwProfiler *profiler = profiler_of(context);
  if (!profiler) goto done;
  profiler->since += own;
  json_t *before = json_array();
  for (int32_t i = 0; after && i < count; i++) json_array_append_new(before, cw_json_number(after[i]));
  json_t *tasks = json_pack("{s:s, s:o, s:o, s:o, s:f, s:I}", "step", step, "task_cost",
                            numbers(cost ? count : 0, cost, 0), "task_after", before, "task_seconds",
                            numbers(count, seconds, 1), "most", own, "bytes", (json_int_t)bytes);
  CW_REQUIRE(json_array_append_new(present_account(profiler)->tasks, tasks) == 0, CW_ERR_MEMORY,
             "out of memory: record of %d tasks", count);
done:
  return status;
}

CwStatus cw_profiler_groups(const CwContext *context, const char *step, int32_t count, const double *cost, double own,
                            int least_ranks) {
  CwStatus status = CW_OK;
  CwProfiler *profiler = profiler_of(context);
  if (!profiler) goto done;
  CW_GROW(profiler->step, profiler->step_capacity, profiler->step_count + 1);
  Sides *made = &profiler->step[profiler->step_count++];
  *made = (Sides){.step = step, .own = own, .least_ranks = least_ranks};
  CW_NEW(made->item, count);
  made->count = count;
  for (int32_t s = 0; s < count; s++)
    made->item[s] = (Account){.cost = cost[s], .part_count = 1, .name = {step}, .tasks = json_array()};
done:
  return status;
}

static Account *account_of(CwProfiler *profiler, int32_t item) {
  return &profiler->step[profiler->step_count - 1].item[item];
}

void cw_profiler_item(const CwContext *context, int32_t item) {
  CwProfiler *profiler = profiler_of(context);
  if (!profiler) return;
  close_part(profiler);
  profiler->present = item < 0 ? NULL : account_of(profiler, item);
}

// most: of each part; NULL: not known.
static CwStatus account_json(const Account *account, const double *most, json_t **made) {
  CwStatus status = CW_OK;
  json_t *parts = json_array();
  for (int i = 0; i < account->part_count; i++) {
    CW_REQUIRE(
        json_array_append_new(parts, json_pack("{s:s, s:o, s:o}", "part", account->name[i], "seconds",
                                               rounded(account->spent[i]), "most", rounded(most ? most[i] : 0))) == 0,
        CW_ERR_MEMORY, "out of memory: record of a part");
  }
  *made = json_pack("{s:O, s:O}", "every_rank", parts, "tasks", account->tasks);
  CW_REQUIRE(*made, CW_ERR_MEMORY, "out of memory: record of the profiler");
done:
  json_decref(parts);
  return status;
}

CwStatus cw_profiler_pack(const CwContext *context, int32_t item, char **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CwProfiler *profiler = profiler_of(context);
  json_t *account = NULL;
  *size = 0;
  if (!profiler) goto done;
  CW_TRY(account_json(account_of(profiler, item), NULL, &account));
  *bytes = json_dumps(account, JSON_COMPACT);
  CW_REQUIRE(*bytes, CW_ERR_MEMORY, "out of memory: account of an item");
  *size = (int64_t)strlen(*bytes);
done:
  json_decref(account);
  return status;
}

CwStatus cw_profiler_take(const CwContext *context, int32_t item, const char *bytes, int64_t size) {
  CwStatus status = CW_OK;
  CwProfiler *profiler = profiler_of(context);
  size_t i;
  json_t *part, *tasks;
  if (!profiler) goto done;
  Account *account = account_of(profiler, item);
  account->taken = json_loadb(bytes, (size_t)size, 0, NULL);
  CW_REQUIRE(account->taken, CW_ERR_MEMORY, "out of memory: account of a part");
  account->part_count = 0;
  json_array_foreach(json_object_get(account->taken, "every_rank"), i, part) {
    account->name[account->part_count++] = json_string_value(json_object_get(part, "part"));
  }
  json_decref(account->tasks);
  account->tasks = json_incref(json_object_get(account->taken, "tasks"));
  json_array_foreach(account->tasks, i, tasks) json_object_set_new(tasks, "most", json_real(0)); // not of this rank
done:
  return status;
}

// With the greatest seconds of all ranks. Collective.
static CwStatus account_of_all(const CwContext *context, const Account *account, json_t **made) {
  CwStatus status = CW_OK;
  double *most = NULL, *of_tasks;
  size_t i, parts = (size_t)account->part_count, count = parts + json_array_size(account->tasks);
  json_t *tasks;
  CW_NEW(most, count);
  of_tasks = most + parts;
  memcpy(most, account->spent, parts * sizeof *most);
  json_array_foreach(account->tasks, i, tasks) of_tasks[i] = json_number_value(json_object_get(tasks, "most"));
  cw_team_most(cw_team_of(context), (int64_t)count, most);
  json_array_foreach(account->tasks, i, tasks) json_object_set_new(tasks, "most", rounded(of_tasks[i]));
  CW_TRY(account_json(account, most, made));
done:
  free(most);
  return status;
}

CwStatus cw_profiler_json(const CwContext *context, json_t **account, json_t **groups) {
  CwStatus status = CW_OK;
  CwProfiler *profiler = profiler_of(context);
  close_part(profiler);
  *account = NULL;
  *groups = json_array();
  CW_TRY(account_of_all(context, &profiler->all, account));
  for (int32_t i = 0; i < profiler->step_count; i++) {
    const Sides *step = &profiler->step[i];
    json_t *array = json_array(), *made = NULL;
    json_array_append_new(*groups, json_pack("{s:s, s:f, s:i, s:o}", "step", step->step, "own", step->own,
                                             "least_ranks", step->least_ranks, "side", array));
    for (int32_t s = 0; s < step->count; s++) {
      CW_TRY(account_of_all(context, &step->item[s], &made));
      json_object_set_new(made, "cost", cw_json_number(step->item[s].cost));
      json_array_append_new(array, made);
    }
  }
done:
  if (status != CW_OK) {
    json_decref(*account);
    json_decref(*groups);
  }
  return status;
}

static void free_account(Account *account) {
  json_decref(account->tasks);
  json_decref(account->taken);
}

void cw_profiler_free(CwProfiler **made) {
  CwProfiler *profiler = *made;
  if (!profiler) return;
  for (int32_t i = 0; i < profiler->step_count; i++) {
    for (int32_t s = 0; s < profiler->step[i].count; s++) free_account(&profiler->step[i].item[s]);
    free(profiler->step[i].item);
  }
  free_account(&profiler->all);
  free(profiler->step);
  free(profiler);
  *made = NULL;
}
