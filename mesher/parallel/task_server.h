// SPDX-License-Identifier: AGPL-3.0-or-later
// Gives tasks to the ranks of a team, each to the rank that asks next. A thread of the team's first rank answers, so
// that no rank waits for a task of another to end; it sleeps between its looks for messages. Two-sided messages alone.
// For the files of this room, and for threads of a rank that may send at a time (team.h).
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/status.h"

// Tasks by place, in the order in which they are given.
typedef struct {
  int32_t count;
  const double *left;    // predicted cost of a place and of all behind it; one entry more, 0
  const int32_t *before; // a place ahead that has to have ended before this one is given, -1: none; NULL: none waits
} CwTaskOrder;

// The places first .. first + count - 1; count 0: none is left.
typedef struct {
  int32_t first, count, left; // left: places behind them
} CwPlaces;

typedef struct CwTaskServer CwTaskServer;

// Collective over the team; all ranks give the same order; team and order last until the server stops. CW_ERR_MEMORY,
// CW_ERR_LIBRARY where there is no thread.
CwStatus cw_task_server_start(const CwTeam *team, const CwTaskOrder *order, CwTaskServer **server);

// The places that this rank had last have ended, in_vain: with all that wait for them, which are not given any more.
// Returns the next. They are so many that their cost is a quarter of a rank's part of what is left at most, one at
// least (guided self-scheduling: Polychronopoulos and Kuck 1987), and one where tasks wait for others. Waits until
// there is one to be had or none is left; on the first rank calls `meanwhile` (may be NULL) with `given` and the number
// that are known to have ended.
CwPlaces cw_task_server_next(CwTaskServer *server, int in_vain, void (*meanwhile)(void *given, int64_t ended),
                             void *given);

// Before place places->first + at is run: the first rank answers who has asked meanwhile, sooner than its thread would;
// another one asks for more before its last place, so that it need not wait for the answer, unless there is so little
// left that a rank which has nothing to do should get it, or tasks wait for others.
void cw_task_server_look(CwTaskServer *server, const CwPlaces *places, int32_t at);

// After count 0 on all ranks. NULL is fine.
void cw_task_server_stop(CwTaskServer *server);
