// SPDX-License-Identifier: AGPL-3.0-or-later
// Dynamic distribution of tasks over MPI ranks: largest first, each rank takes the next when it is free;
// results go to all ranks. With one rank the same code runs the tasks in the same order of results. A failing
// task ends the run within seconds with one message.
#ifndef CUTWATER_MESHER_PARALLEL_SCHEDULE_H
#define CUTWATER_MESHER_PARALLEL_SCHEDULE_H

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Runs task `task`; may return a byte buffer (malloc'd) as its result through *bytes and *size, or leave them
// 0.
typedef CwStatus (*CwTask)(void *context, int32_t task, void **bytes, int64_t *size);

typedef struct {
  const char *step; // "surface patches", also in the ledger
  const char *unit; // "patches"; NULL: a part of a step, without progress of its own
  int32_t count;
  const double *cost; // predicted, any unit; largest is taken first, ties by index
  // Of each task another that has to have ended, on whichever rank, before it begins: of smaller index and at no less
  // cost, so that it is taken before; -1: none. NULL: no task waits.
  const int32_t *after;
  CwTask run;
  void *context;
  int gather; // 1: every rank gets every result in bytes[task], size[task]
} CwSchedule;

// How to start the ranks (Open MPI), so that nothing but the one error line is seen and any number of ranks
// may run as root:
//   OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun -q --oversubscribe -n RANKS
//   cutwater-mesh ...
// Without -q the same happens, with Open MPI's own paragraphs below the line. The exit status of mpirun is
// that of the failure (cw_log_error); 137 where a rank was killed by signal 9, and the others end within two
// seconds.

// Starts MPI (once per process); gives rank and number of ranks. Collective.
CwStatus cw_mpi_start(int *argc, char ***argv, int *rank, int *ranks);
// Ends MPI. Collective: after a failure on one rank only, call cw_mpi_fail instead.
void cw_mpi_end(void);
// Ends all ranks at once after a failure of this one: prints the one error line and aborts. Where several
// ranks fail, one of them prints. Does not return where there is more than one rank; else returns the exit
// status for main().
int cw_mpi_fail(CwStatus status);

// This rank and how many there are, 0 of 1 without cw_mpi_start.
int cw_mpi_rank(void);
int cw_mpi_ranks(void);

// Splits the ranks into teams: until they join again schedules run over the ranks that gave the same number, which get
// results from one another alone. Collective over all ranks, as is cw_mpi_join; a rank that waits there sleeps.
void cw_mpi_split(int number);
void cw_mpi_join(void);

// `size` bytes of the rank `from` to the others. Collective over all ranks.
void cw_mpi_broadcast(void *bytes, int64_t size, int from);

// The greatest of all ranks, for each of `count` values. Collective over all ranks.
void cw_mpi_most(int32_t count, double *value);

// Runs all tasks. Collective; all ranks give the same schedule. Without cw_mpi_start there is one rank.
// `bytes` and `size` (arrays of count, zeroed) receive results where `gather`; the caller frees bytes[i].
// `seconds` (count, may be NULL) receives the processor time of each task on all ranks: what else runs on the machine
// does not count.
// Without `gather` a result stays on the rank that ran the task. A rank that waits sleeps, so that more ranks
// than cores cost nothing. The next task is taken without the help of rank 0 where ranks share memory;
// between machines it may have to wait until rank 0 ends its own task. A failing task: with one rank the
// failure is returned; else all ranks end (cw_mpi_fail).
CwStatus cw_schedule_run(const CwSchedule *schedule, void **bytes, int64_t *size, double *seconds);

#ifdef __cplusplus
}
#endif
#endif
