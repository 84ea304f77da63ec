// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the processor time of the ranks goes: into tasks, schedule by schedule, or into what every rank does for
// itself, part by part; what ranks do on one item while others are on another (groups.h) is kept apart, side by side. A
// model of more ranks follows from it (tests/bench/speedup.py). A rank has one, and the context hands it on; without
// one nothing is kept.
#pragma once

#include <jansson.h>
#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/status.h"

// [out] profiler: the caller's, freed by cw_profiler_free. Time counts from here on, to the part "start".
CwStatus cw_profiler_make(CwProfiler **profiler);

// What this rank does outside of tasks counts to `part` from here to the next call (a string that lasts); returns the
// part before ("" without a profiler). All ranks call in the same order.
const char *cw_profiler_part(const CwContext *context, const char *part);

// A schedule has run. `cost`, `after` (CwSchedule; may be NULL) and `seconds` of its tasks; `own` seconds of this
// rank's tasks, which do not count to the present part; bytes of results that every rank got.
CwStatus cw_profiler_tasks(const CwContext *context, const char *step, int32_t count, const double *cost,
                           const int32_t *after, const double *seconds, double own, int64_t bytes);

// A step goes on side by side: accounts for `count` items, of predicted costs of which the share `own` is what every
// rank of an item does for itself, by groups of so many ranks at least. All ranks.
CwStatus cw_profiler_groups(const CwContext *context, const char *step, int32_t count, const double *cost, double own,
                            int least_ranks);
// From here to the next call all parts and tasks of this rank count to an item of the last step; -1: to no item.
void cw_profiler_item(const CwContext *context, int32_t item);
// The account of an item of the last step, to travel to the ranks that had no part in it.
CwStatus cw_profiler_pack(const CwContext *context, int32_t item, char **bytes, int64_t *size);
CwStatus cw_profiler_take(const CwContext *context, int32_t item, const char *bytes, int64_t size);

// A profiler is needed. [out] account, groups: references of the caller. *account: {"every_rank": [{"part", "seconds",
// "most"}], "tasks": [{"step", "task_cost", "task_after", "task_seconds", "most", "bytes"}]}: seconds of rank 0, and of
// the rank with most. *items: [{"step", "own", "least_ranks", "side": [account with "cost"]}]. Collective.
CwStatus cw_profiler_json(const CwContext *context, json_t **account, json_t **groups);

// NULL is fine.
void cw_profiler_free(CwProfiler **profiler);
