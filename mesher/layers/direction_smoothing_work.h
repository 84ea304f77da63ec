// SPDX-License-Identifier: AGPL-3.0-or-later
// What the parts of the smoothing share: direction_smoothing finds its sources, direction_smoothing_reach what they
// reach, direction_smoothing_block solves it.
#pragma once

#include "mesher/layers/layer_columns.h"
#include "mesher/parallel/schedule.h"
#include "pipeline/status.h"

enum { CW_SMOOTHING_BLOCK = 4096 }; // vertices

// Of every vertex: the nearest source along edges.
typedef struct {
  double distance;
  int32_t source; // place in the list; -1: out of reach
} CwSmoothingReach;

// A vertex whose column is given.
typedef struct {
  int32_t vertex;
  double opening, thickness; // cot(alpha/2) and thickness
  double u[3], line[3]; // displacement relative to an undisturbed neighbour, m; direction in which it may still lean
} CwSmoothingSource;

// A column as the smoothing leaves it: its displacement relative to an undisturbed neighbour, and how far it was
// widened.
typedef struct {
  double column[3], u[3], widen;
  int32_t changed; // by the last smoothing
} CwLean;

// What all blocks share. The vertices in reach are divided into blocks along the curve of the domain's tree. A block is
// solved together with the vertices up to HALO edges around it, whose displacement counts in their own block alone: the
// solution forgets within a few edges what it was held to beyond them, and the next smoothing goes on from what all
// have found. Sources, reach and blocks are those of the first smoothing, when no thickness is greater.
typedef struct CwSmoothing {
  const CwLayerWork *work;
  int32_t source_count;
  CwSmoothingSource *source; // in order of their vertices
  CwSmoothingReach *reach;
  int32_t count;           // vertices in reach that may lean
  int32_t *member, *place; // these, block by block; the place of each vertex among them, -1: none of them
  CwTaskResults lean; // the CwLean of the members of each block, as the last smoothing left them; none before the first
  double *lean_t;     // of each vertex: the thickness it was made for; negative out of reach
} CwSmoothing;

// Sets `reach` from the sources. Collective.
CwStatus cw_smoothing_find_reach(CwSmoothing *smoothing);

// Solves one block: a task (CwTask) over CwSmoothing; gives the CwLean of its members.
CwStatus cw_smoothing_solve_block(void *smoothing, int32_t block, void **bytes, int64_t *size);
