// SPDX-License-Identifier: AGPL-3.0-or-later
// The ranks of MPI: start, end, failure, and what those of a team do together. MPI itself is one a process, and a
// failure ends all of it: cw_mpi_fail and cw_mpi_ranks ask MPI. All else is handed its team.
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
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

// Starts MPI, once in a process. [out] all: the team of all ranks, freed by cw_mpi_end. Collective.
CwStatus cw_mpi_start(int *argc, char ***argv, CwTeam **all);
// Ends MPI; nothing where *all is NULL. Collective: after a failure on one rank only, call cw_mpi_fail instead.
void cw_mpi_end(CwTeam **all);
// Ends all ranks of the process's MPI at once after a failure of this one: prints the one error line and aborts. Where
// several ranks fail, the first to call cw_stop_claim (pipeline/stop_line.h) prints; without cw_stop_watch each does
// that gets to it before it is ended. Does not return where there is more than one rank; else returns the exit status
// for main().
int cw_mpi_fail(CwLog *log, CwStatus status);
// How many ranks MPI has; 1 where it has not started.
int cw_mpi_ranks(void);

// This rank of the team, from 0, and how many there are.
int cw_team_rank(const CwTeam *team);
int cw_team_ranks(const CwTeam *team);

// All that follows is collective over the team.

// What all do before they have a folder to watch, and where any of them may fail: returns `status` on all, or on the
// first that failed, which is to end all; the others wait for that.
CwStatus cw_team_agree(const CwTeam *team, CwStatus status);

// [out] part: the ranks that gave the same number, until cw_team_join frees it; a rank that waits there sleeps.
CwStatus cw_team_split(const CwTeam *team, int number, CwTeam **part);
void cw_team_join(const CwTeam *team, CwTeam **part);

// `size` bytes of the rank `from` to the others. [in,out] bytes.
void cw_team_broadcast(const CwTeam *team, void *bytes, int64_t size, int from);

// The size[rank] bytes at all[rank] of each rank to all the others, at the same place. [in,out] all[ranks]: room for as
// many bytes each. CW_ERR_MEMORY.
CwStatus cw_team_gather(const CwTeam *team, const int64_t *size, void **all);

// What all ranks compute for themselves, and go on by, is to be the same to the last bit; `what`: its name, plural.
// CW_ERR_LIBRARY on all ranks where their digests of it are not the same.
CwStatus cw_team_alike(const CwTeam *team, const char *what, uint64_t digest);

// The greatest of all ranks, for each of `count` values. [in,out] value.
void cw_team_most(const CwTeam *team, int64_t count, double *value);

#ifdef __cplusplus
}
#endif
