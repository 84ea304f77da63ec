// SPDX-License-Identifier: AGPL-3.0-or-later
// What a team of ranks is made of, and how its ranks wait. For the files of this room.
#ifndef CUTWATER_MESHER_PARALLEL_TEAM_H
#define CUTWATER_MESHER_PARALLEL_TEAM_H

#include <mpi.h>
#include <stdint.h>

#include "mesher/parallel/context.h"

struct CwTeam {
  int rank, ranks;
  int threads; // 1: several threads of a rank may send at a time
  MPI_Comm comm;
};

// The team of a context; one of this rank alone where it has none.
const CwTeam *cw_team_of(const CwContext *context);

// Waits for a message asleep: MPI's own wait keeps its core busy, which another rank may need.
void cw_team_wait(MPI_Request *request);
void cw_team_barrier(const CwTeam *team);
void cw_team_sleep(double seconds);

// The pause after which one looks again, shorter than a third of the time waited so far: of the first look and of
// others.
extern const double CW_TEAM_PAUSE;
double cw_team_longer(double pause);

#endif
