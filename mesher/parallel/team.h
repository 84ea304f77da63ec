// SPDX-License-Identifier: AGPL-3.0-or-later
// What a team of ranks is made of, and how its ranks wait. For the files of this room.
#pragma once

#include <mpi.h>

#include "mesher/parallel/context.h"
#include "mesher/parallel/threads.h"

struct CwTeam {
  int rank, ranks;
  int threads; // 1: several threads of a rank may send at a time
  MPI_Comm comm;
  // Of all ranks:
  CwTeam *host;   // those of this host; NULL in a part of the ranks
  CwTeam *firsts; // the first ranks of the hosts; NULL on others
  int hosts;
  int *host_of;     // of each rank the first rank on its host
  cpu_set_t *cores; // where each may run
  // Of ranks that work in the place of others:
  CwThreads *pool;       // of this rank; NULL: it works alone
  int slots, *slot_rank; // threads of all its ranks; the rank of each; NULL: one a rank
};

// The team of a context; one of this rank alone where it has none.
const CwTeam *cw_team_of(const CwContext *context);

// Waits for a message, at length asleep: MPI's own wait keeps its core busy, which another rank may need.
void cw_team_wait(MPI_Request *request);
void cw_team_barrier(const CwTeam *team);
// Processor time of this thread.
double cw_team_thread_seconds(void);

// The same for who looks for something else: after each look in vain cw_team_wait_on(), which sleeps no longer than
// about a third of the time waited so far.
typedef struct {
  double pause, until;      // s: of the next sleep; when the first may begin
  double seen, used, since; // s: the last look; processor time of this thread at the time `since`
  int looks;
} CwTeamWait;
CwTeamWait cw_team_wait_begin(void);
void cw_team_wait_on(CwTeamWait *wait);
