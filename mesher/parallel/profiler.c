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

typedef struct {
  const char *step;
  int32_t count;
  double *cost, *seconds; // cost: NULL where all are alike
  double *after;          // indices of tasks, -1: none; NULL where no task waits
  double own;
  int64_t bytes;
} Entry;

// What all ranks do together, or those of one item.
typedef struct {
  double cost;          // predicted, of an item
  int part_count, part; // the present one
  const char *name[PARTS_MOST];
  double spent[PARTS_MOST];
  int32_t entry_count, entry_capacity;
  Entry *entry;
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
  int32_t step_count;
  Sides *step;
};

CwStatus cw_profiler_make(CwProfiler **made) {
  CwStatus status = CW_OK;
  CW_NEW(*made, 1);
  (*made)->all = (Account){.part_count = 1, .name = {"start"}};
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

static CwStatus new_entry(Account *account, Entry **entry) {
  CwStatus status = CW_OK;
  CW_GROW(account->entry, account->entry_capacity, account->entry_count + 1);
  *entry = &account->entry[account->entry_count++];
  **entry = (Entry){0};
done:
  return status;
}

CwStatus cw_profiler_tasks(const CwContext *context, const char *step, int32_t count, const double *cost,
                           const int32_t *after, const double *seconds, double own, int64_t bytes) {
  CwStatus status = CW_OK;
  CwProfiler *profiler = profiler_of(context);
  Entry *entry = NULL;
  if (!profiler) goto done;
  profiler->since += own;
  CW_TRY(new_entry(present_account(profiler), &entry));
  *entry = (Entry){.step = step, .own = own, .bytes = bytes};
  CW_NEW(entry->seconds, count);
  memcpy(entry->seconds, seconds, (size_t)count * sizeof *seconds);
  if (cost) {
    CW_NEW(entry->cost, count);
    memcpy(entry->cost, cost, (size_t)count * sizeof *cost);
  }
  if (after) {
    CW_NEW(entry->after, count);
    for (int32_t i = 0; i < count; i++) entry->after[i] = after[i];
  }
  entry->count = count;
done:
  return status;
}

CwStatus cw_profiler_groups(const CwContext *context, const char *step, int32_t count, const double *cost, double own,
                            int least_ranks) {
  CwStatus status = CW_OK;
  CwProfiler *profiler = profiler_of(context);
  if (!profiler) goto done;
  Sides *larger = realloc(profiler->step, (size_t)(profiler->step_count + 1) * sizeof *larger);
  CW_REQUIRE(larger, CW_ERR_MEMORY, "out of memory: %d steps side by side", profiler->step_count + 1);
  profiler->step = larger;
  Sides *made = &profiler->step[profiler->step_count++];
  *made = (Sides){.step = step, .own = own, .least_ranks = least_ranks};
  CW_NEW(made->item, count);
  made->count = count;
  for (int32_t s = 0; s < count; s++) made->item[s] = (Account){.cost = cost[s], .part_count = 1, .name = {step}};
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

// most: of each part and then of each list of tasks; NULL: not known.
static CwStatus account_json(const Account *account, const double *most, json_t **made) {
  CwStatus status = CW_OK;
  json_t *parts = json_array(), *tasks = json_array();
  for (int i = 0; i < account->part_count; i++) {
    CW_REQUIRE(
        json_array_append_new(parts, json_pack("{s:s, s:o, s:o}", "part", account->name[i], "seconds",
                                               rounded(account->spent[i]), "most", rounded(most ? most[i] : 0))) == 0,
        CW_ERR_MEMORY, "out of memory: record of a part");
  }
  for (int32_t i = 0; i < account->entry_count; i++) {
    const Entry *entry = &account->entry[i];
    double longest = most ? most[account->part_count + i] : 0;
    CW_REQUIRE(
        json_array_append_new(tasks, json_pack("{s:s, s:o, s:o, s:o, s:o, s:I}", "step", entry->step, "task_cost",
                                               numbers(entry->cost ? entry->count : 0, entry->cost, 0), "task_after",
                                               numbers(entry->after ? entry->count : 0, entry->after, 0),
                                               "task_seconds", numbers(entry->count, entry->seconds, 1), "most",
                                               rounded(longest), "bytes", (json_int_t)entry->bytes)) == 0,
        CW_ERR_MEMORY, "out of memory: record of %d tasks", entry->count);
  }
  *made = json_pack("{s:o, s:o}", "every_rank", json_incref(parts), "tasks", json_incref(tasks));
  CW_REQUIRE(*made, CW_ERR_MEMORY, "out of memory: record of the profiler");
done:
  json_decref(parts);
  json_decref(tasks);
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

// The numbers of a JSON array; NULL where it has none.
static CwStatus take_numbers(const json_t *array, double **value) {
  CwStatus status = CW_OK;
  if (json_array_size(array) == 0) goto done;
  CW_NEW(*value, json_array_size(array));
  for (size_t i = 0; i < json_array_size(array); i++) (*value)[i] = json_number_value(json_array_get(array, i));
done:
  return status;
}

CwStatus cw_profiler_take(const CwContext *context, int32_t item, const char *bytes, int64_t size) {
  CwStatus status = CW_OK;
  CwProfiler *profiler = profiler_of(context);
  size_t i;
  json_t *part;
  if (!profiler) goto done;
  Account *account = account_of(profiler, item);
  account->taken = json_loadb(bytes, (size_t)size, 0, NULL);
  CW_REQUIRE(account->taken, CW_ERR_MEMORY, "out of memory: account of a part");
  account->part_count = 0;
  json_array_foreach(json_object_get(account->taken, "every_rank"), i, part) {
    account->name[account->part_count++] = json_string_value(json_object_get(part, "part"));
  }
  json_array_foreach(json_object_get(account->taken, "tasks"), i, part) {
    const json_t *seconds = json_object_get(part, "task_seconds");
    Entry *entry = NULL;
    CW_TRY(new_entry(account, &entry));
    entry->step = json_string_value(json_object_get(part, "step"));
    entry->bytes = json_integer_value(json_object_get(part, "bytes"));
    CW_TRY(take_numbers(json_object_get(part, "task_cost"), &entry->cost));
    CW_TRY(take_numbers(json_object_get(part, "task_after"), &entry->after));
    CW_TRY(take_numbers(seconds, &entry->seconds));
    entry->count = (int32_t)json_array_size(seconds);
  }
done:
  return status;
}

// With the greatest seconds of all ranks. Collective.
static CwStatus account_of_all(const CwContext *context, const Account *account, json_t **made) {
  CwStatus status = CW_OK;
  double *most = NULL;
  int32_t count = account->part_count + account->entry_count;
  CW_NEW(most, count);
  memcpy(most, account->spent, (size_t)account->part_count * sizeof *most);
  for (int32_t i = 0; i < account->entry_count; i++) most[account->part_count + i] = account->entry[i].own;
  cw_team_most(cw_team_of(context), count, most);
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
  for (int32_t i = 0; i < account->entry_count; i++) {
    free(account->entry[i].cost);
    free(account->entry[i].after);
    free(account->entry[i].seconds);
  }
  free(account->entry);
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
