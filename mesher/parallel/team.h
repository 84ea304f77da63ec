// SPDX-License-Identifier: AGPL-3.0-or-later
// The ranks that work together now: all, or between cw_mpi_split and cw_mpi_join those of one team. For the files of
// this room.
#ifndef CUTWATER_MESHER_PARALLEL_TEAM_H
#define CUTWATER_MESHER_PARALLEL_TEAM_H

#include <mpi.h>
#include <stdint.h>

typedef struct {
  int rank, ranks;
  int threads; // 1: several threads of a rank may send at a time
  MPI_Comm comm;
} CwTeam;

const CwTeam *cw_team(void);

// Waits for a message asleep: MPI's own wait keeps its core busy, which another rank may need.
void cw_team_wait(MPI_Request *request);
void cw_team_barrier(void);
void cw_team_sleep(double seconds);

// The pause after which one looks again, shorter than a third of the time waited so far: of the first look and of
// others.
extern const double CW_TEAM_PAUSE;
double cw_team_longer(double pause);

// The greatest of the ranks, for each of `count` values.
void cw_team_most(int32_t count, double *value);

// `size` bytes of the rank `owner` of the team to its others.
void cw_team_broadcast(void *bytes, int64_t size, int owner);

#endif
