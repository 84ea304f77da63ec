// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the processor time of the ranks goes: into tasks, schedule by schedule, or into what every rank does for itself,
// part by part. A model of more ranks follows from it (tests/bench/speedup.py). One per process, as MPI.
#ifndef CUTWATER_MESHER_LEDGER_H
#define CUTWATER_MESHER_LEDGER_H

#include <jansson.h>
#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// What this rank does outside of tasks counts to `part` from here to the next call (a string that lasts); returns the part
// before. All ranks call in the same order; the time before the first call is that of the part "start".
const char *cw_ledger_part(const char *part);

// A schedule has run. `cost` (may be NULL) and `seconds` of its tasks; `own` seconds of this rank's tasks, which do not
// count to the present part; bytes of results that every rank got.
CwStatus cw_ledger_tasks(const char *step, int32_t count, const double *cost, const double *seconds, double own,
                         int64_t bytes);

// {"parts": [{"part", "seconds", "most"}], "tasks": [{"step", "task_cost", "task_seconds", "most", "bytes"}]}: seconds of
// rank 0, and of the rank with most. Collective.
CwStatus cw_ledger_json(json_t **parts, json_t **tasks);

void cw_ledger_free(void);

#ifdef __cplusplus
}
#endif
#endif
