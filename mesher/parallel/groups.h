// SPDX-License-Identifier: AGPL-3.0-or-later
// Steps in which what every rank does for itself weighs: the ranks go apart in groups, each of which works on some of
// the items (domains) while the others are on others, and hand what they have made to all. Few ranks stay together, on
// one item after the other. Where a step's data is large, one rank of a group on each host does the work, with a thread
// for each of them, and the results lie once on each host.
#pragma once

#include <stdint.h>

#include "mesher/parallel/host_memory.h"
#include "mesher/parallel/outcome.h"
#include "pipeline/status.h"

enum { CW_GROUPS_MOST = 64 }; // items: as many domains as a model may have

// An item while its results are handed over.
typedef struct {
  const CwTeam *team; // all ranks
  int32_t item;
  int mine; // this rank has them; else it gets them
  int from; // rank that gives them
  // Where one rank of a group works on each host:
  int maker;      // the rank of this host's team that has them; -1: none on this host
  int everywhere; // 1: one on each host has them
} CwGroupHand;

typedef struct {
  const char *step;   // in the profiler
  int32_t count;      // items
  const double *cost; // predicted, of each
  double own;         // the share of the cost that every rank of a group does for itself
  int by_threads;     // 1: one rank of a group on each host works, by threads; what `run` spreads is safe for them
  // Works on an item: collective over the ranks of the group (with by_threads over those that work), with the same
  // result and outcome on all of them. given: as below; context: that of the group.
  CwStatus (*run)(void *given, const CwContext *context, int32_t item, CwOutcome *outcome);
  // Gives the results of an item that is done, or thin, to the ranks that have not run it, by cw_group_give and, with
  // by_threads, cw_group_hold. Collective over all ranks.
  CwStatus (*hand)(void *given, const CwGroupHand *hand);
  void *given;
} CwGroupWork;

// Runs all items. outcome[item], the same on all ranks: that of `run`. Failures end all ranks, or are returned where
// there is one.
CwStatus cw_groups_run(const CwContext *context, const CwGroupWork *work, CwOutcome *outcome);

// Hands over `size` bytes, as many on all ranks. Straight from array to array.
void cw_group_give(const CwGroupHand *hand, void *data, int64_t size);

// Hands over a product of `size` bytes: its numbers, and its arrays, once for each host, which nobody changes from here
// on. [in,out] memory: the field of the product for where they lie. CW_ERR_MEMORY.
CwStatus cw_group_hold(const CwGroupHand *hand, void *product, int64_t size, CwArrays arrays, CwHostMemory **memory);

// Groups for so many ranks: group_of[item]; ranks_of[group]. An item takes cost * (own + (1 - own) / ranks), a group
// the sum of its items; so many groups are made, of at least `least` ranks each, that the longest takes the least time.
int cw_groups_divide(int32_t count, const double *cost, double own, int ranks, int least, int *group_of, int *ranks_of);
