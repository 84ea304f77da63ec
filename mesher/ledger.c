// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/ledger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/schedule.h"
#include "pipeline/log.h"
#include "pipeline/record.h"

enum { PARTS_MOST = 64 };

typedef struct {
  const char *step;
  int32_t count;
  double *cost, *seconds; // cost: NULL where all are alike
  double own;
  int64_t bytes;
} Entry;

static struct {
  int part_count, part; // the present one
  const char *name[PARTS_MOST];
  double spent[PARTS_MOST], since; // since: when the present part went on
  int32_t entry_count, entry_capacity;
  Entry *entry;
} ledger = {.part_count = 1, .name = {"start"}};

const char *cw_ledger_part(const char *part) {
  const char *before = ledger.name[ledger.part];
  double now = cw_processor_seconds();
  ledger.spent[ledger.part] += now - ledger.since;
  ledger.since = now;
  int at = 0;
  while (at < ledger.part_count && strcmp(ledger.name[at], part)) at++;
  if (at == PARTS_MOST) at = 0;
  if (at == ledger.part_count) ledger.name[ledger.part_count++] = part;
  ledger.part = at;
  return before;
}

CwStatus cw_ledger_tasks(const char *step, int32_t count, const double *cost, const double *seconds, double own,
                         int64_t bytes) {
  CwStatus status = CW_OK;
  Entry made = {.step = step, .count = count, .own = own, .bytes = bytes};
  ledger.since += own;
  if (ledger.entry_count == ledger.entry_capacity) {
    int32_t capacity = ledger.entry_capacity ? 2 * ledger.entry_capacity : 256;
    Entry *entry = realloc(ledger.entry, (size_t)capacity * sizeof *entry);
    CW_REQUIRE(entry, CW_ERR_MEMORY, "out of memory: %d schedules", capacity);
    ledger.entry = entry;
    ledger.entry_capacity = capacity;
  }
  if (cost) {
    CW_NEW(made.cost, count);
    memcpy(made.cost, cost, (size_t)count * sizeof *cost);
  }
  CW_NEW(made.seconds, count);
  memcpy(made.seconds, seconds, (size_t)count * sizeof *seconds);
  ledger.entry[ledger.entry_count++] = made;
  made = (Entry){0};
done:
  free(made.cost);
  free(made.seconds);
  return status;
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

CwStatus cw_ledger_json(json_t **parts, json_t **tasks) {
  CwStatus status = CW_OK;
  double *most = NULL;
  cw_ledger_part(ledger.name[ledger.part]);
  CW_NEW(most, ledger.part_count + ledger.entry_count);
  memcpy(most, ledger.spent, (size_t)ledger.part_count * sizeof *most);
  for (int32_t i = 0; i < ledger.entry_count; i++) most[ledger.part_count + i] = ledger.entry[i].own;
  cw_mpi_most(ledger.part_count + ledger.entry_count, most);
  *parts = json_array();
  *tasks = json_array();
  for (int i = 0; i < ledger.part_count; i++) {
    CW_REQUIRE(json_array_append_new(*parts, json_pack("{s:s, s:o, s:o}", "part", ledger.name[i], "seconds",
                                                       rounded(ledger.spent[i]), "most", rounded(most[i]))) == 0,
               CW_ERR_MEMORY, "out of memory: record of a part");
  }
  for (int32_t i = 0; i < ledger.entry_count; i++) {
    const Entry *entry = &ledger.entry[i];
    CW_REQUIRE(json_array_append_new(*tasks, json_pack("{s:s, s:o, s:o, s:o, s:I}", "step", entry->step, "task_cost",
                                                       numbers(entry->cost ? entry->count : 0, entry->cost, 0),
                                                       "task_seconds", numbers(entry->count, entry->seconds, 1), "most",
                                                       rounded(most[ledger.part_count + i]), "bytes",
                                                       (json_int_t)entry->bytes)) == 0,
               CW_ERR_MEMORY, "out of memory: record of %d tasks", entry->count);
  }
done:
  free(most);
  return status;
}

void cw_ledger_free(void) {
  for (int32_t i = 0; i < ledger.entry_count; i++) {
    free(ledger.entry[i].cost);
    free(ledger.entry[i].seconds);
  }
  free(ledger.entry);
  ledger.entry = NULL;
  ledger.entry_count = ledger.entry_capacity = 0;
}
