// SPDX-License-Identifier: AGPL-3.0-or-later
// The ranks that work together now: all, or between cw_mpi_split and cw_mpi_join those of one team. For the files of
// this room.
#ifndef CUTWATER_MESHER_PARALLEL_TEAM_H
#define CUTWATER_MESHER_PARALLEL_TEAM_H

#include <mpi.h>
#include <stdint.h>

typedef struct {
  int rank, ranks, first; // first: its first rank's number among all
  MPI_Comm comm;
} CwTeam;

const CwTeam *cw_team(void);

// Counters that all ranks of a team add to without the help of its first rank, on which they stand. Returns what was
// there before. Of more than one rank only.
typedef enum { CW_TEAM_NEXT, CW_TEAM_DONE, CW_TEAM_FAILED, CW_TEAM_COUNTERS } CwTeamCounter;
int64_t cw_team_add(CwTeamCounter counter, int64_t amount);

// A barrier that sleeps, and calls `meanwhile` (may be NULL) now and then: the blocking one keeps its core busy, which
// another rank may need.
void cw_team_barrier(void (*meanwhile)(void));
void cw_team_sleep(double seconds);

// `size` bytes of the rank `owner` of the team to its others.
void cw_team_broadcast(void *bytes, int64_t size, int owner);

#endif
