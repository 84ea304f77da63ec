// SPDX-License-Identifier: AGPL-3.0-or-later
// Steps in which what every rank does for itself weighs: the ranks go apart in groups, each of which works on some of
// the sides (domains) while the others are on others, and hand what they have made to all. Few ranks stay together, on
// one side after the other.
#ifndef CUTWATER_MESHER_PARALLEL_SIDES_H
#define CUTWATER_MESHER_PARALLEL_SIDES_H

#include <stdint.h>

#include "mesher/parallel/outcome.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_SIDES_MOST = 16 };

// A side while its results are handed over.
typedef struct {
  int32_t side;
  int mine; // this rank has them; else it gets them
  int from; // rank that gives them
} CwSideHand;

typedef struct {
  const char *step;   // in the ledger
  int32_t count;      // sides
  const double *cost; // predicted, of each
  double own;         // the share of the cost that every rank of a group does for itself
  // Works on a side: collective over the ranks of the group, with the same result and outcome on all of them.
  CwStatus (*run)(void *context, int32_t side, CwOutcome *outcome);
  // Gives the results of a side to the ranks that have not run it, by cw_side_give. Collective over all ranks.
  CwStatus (*hand)(void *context, const CwSideHand *hand);
  void *context;
} CwSides;

// Runs all sides; collective. outcome[side], the same on all ranks: that of `run`; a side that is not done is not
// handed over. Failures end all ranks, or are returned where there is one.
CwStatus cw_sides_run(const CwSides *sides, CwOutcome *outcome);

// Hands over `size` bytes, as many on all ranks. Straight from array to array.
void cw_side_give(const CwSideHand *hand, void *data, int64_t size);
// The same for an array of `count` items, which is allocated where it comes to.
#define CW_SIDE_ARRAY(hand, pointer, count)                                                                            \
  do {                                                                                                                 \
    if (!(hand)->mine) CW_NEW_UNSET(pointer, count);                                                                   \
    cw_side_give(hand, pointer, (int64_t)(count) * (int64_t)sizeof *(pointer));                                        \
  } while (0)

// Groups for so many ranks: group_of[side]; ranks_of[group]. A side takes cost * (own + (1 - own) / ranks), a group the
// sum of its sides; so many groups are made, of at least two ranks each, that the longest takes the least time.
int cw_sides_group(int32_t count, const double *cost, double own, int ranks, int *group_of, int *ranks_of);

#ifdef __cplusplus
}
#endif
#endif
