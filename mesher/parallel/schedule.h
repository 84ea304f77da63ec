// SPDX-License-Identifier: AGPL-3.0-or-later
// Dynamic distribution of tasks over MPI ranks: largest first, each rank takes the next when it is free; results go to
// all ranks. With one rank the same code runs the tasks in the same order. A failing task ends the run within seconds
// with one message.
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "mesher/parallel/host_memory.h"
#include "pipeline/status.h"

// Runs task `task`; may return a byte buffer (malloc'd) as its result through *bytes and *size, or leave them
// 0.
typedef CwStatus (*CwTask)(void *context, int32_t task, void **bytes, int64_t *size);

typedef struct {
  const char *step; // "surface patches", also in the profiler
  const char *unit; // "patches"; NULL: a part of a step, without progress of its own
  int32_t count;
  const double *cost; // predicted, any unit; largest, with what waits for it, is taken first, ties by index
  // Of each task another of smaller index that has to have ended, on whichever rank, before it begins; -1: none. NULL:
  // no task waits.
  const int32_t *after;
  // Of the result of a task, NULL where it has none: 1 where those that wait for it are left out, without a result.
  // NULL: none is. Asks for `bytes`.
  int (*in_vain)(const void *bytes);
  CwTask run;
  void *context;
  int alike;  // 1: tasks of about the same cost, too short to ask for each: rank r takes every task r + k ranks
  int gather; // 1: every rank gets every result in bytes[task]
  // [out] Where many results lie, once on each host: the caller frees it and not those. NULL there, or NULL: each is
  // the caller's.
  CwHostMemory **held;
} CwSchedule;

// Runs all tasks over the ranks of the context's team; all give the same schedule.
// `bytes` and `size` (arrays of count, zeroed, may be NULL where nothing is gathered) receive results and their sizes;
// the caller frees bytes[i]. Without `gather` a result stays on the rank that ran the task. `seconds` (count, may be
// NULL) receives the processor time of each task on all ranks: what else runs on the machine does not count.
// A rank that waits sleeps, so that more ranks than cores cost nothing. The next task comes from a server that answers
// while tasks run (task_server.h); where MPI allows no threads they are dealt in turn, as those that are alike. Where
// the team works by threads (groups.h) several call `run` at a time, and no task may wait for another: CW_ERR_INPUT. A
// failing task: with one rank the failure is returned; else all ranks end (cw_mpi_fail).
CwStatus cw_schedule_run(const CwContext *context, const CwSchedule *schedule, void **bytes, int64_t *size,
                         double *seconds);

// The results of all tasks on every rank; {0} are none.
typedef struct {
  int32_t count;
  void **bytes;
  int64_t *size;
} CwTaskResults;

// The same with `gather`. Zeroed `results` on entry; the caller frees them whatever is returned, but for bytes that it
// has taken over and set to NULL.
CwStatus cw_schedule_gather(const CwContext *context, const CwSchedule *schedule, CwTaskResults *results);
void cw_task_results_free(CwTaskResults *results);
// Copies all of them, one behind the other, to `to`, unless that is NULL; returns their bytes.
int64_t cw_task_results_join(const CwTaskResults *results, void *to);
