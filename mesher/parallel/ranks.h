// SPDX-License-Identifier: AGPL-3.0-or-later
// The ranks of MPI: start, end, failure, and what all do together.
#ifndef CUTWATER_MESHER_PARALLEL_RANKS_H
#define CUTWATER_MESHER_PARALLEL_RANKS_H

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

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
// Ends all ranks at once after a failure of this one: prints the one error line and aborts. Where several ranks fail,
// the first to call cw_stop_claim (pipeline/stop_line.h) prints; without cw_stop_watch each does that gets to it before
// it is ended. Does not return where there is more than one rank; else returns the exit status for main().
int cw_mpi_fail(CwStatus status);
// What all ranks do before they have a folder to watch, and where any of them may fail: returns `status` on all, or on
// the first that failed, which is to end all; the others wait for that. Collective.
CwStatus cw_mpi_agree(CwStatus status);

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

#ifdef __cplusplus
}
#endif
#endif
