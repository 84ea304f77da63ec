// SPDX-License-Identifier: AGPL-3.0-or-later
// What the parts of the fan share: layers_fan.c finds its sources, layers_fan_reach.c what they reach,
// layers_fan_block.c solves it.
#ifndef CUTWATER_MESHER_LAYERS_LAYERS_FAN_H
#define CUTWATER_MESHER_LAYERS_LAYERS_FAN_H

#include "mesher/layers/layers_inner.h"

enum { CW_FAN_BLOCK = 4096 }; // vertices

// Of a direction that a column may lean in.
#define CW_FAN_LEAST_COSINE 0.3

// Of every vertex: the nearest source along edges.
typedef struct {
  double distance;
  int32_t source; // place in the list; -1: out of reach
} CwFanReach;

// A vertex whose column is given.
typedef struct {
  int32_t vertex;
  double opening, height; // cot(alpha/2) and height
  double u[3], line[3];   // displacement relative to an undisturbed neighbour, m; direction in which it may still lean
} CwFanSource;

// A column as the fan leaves it: its displacement relative to an undisturbed neighbour, and how far it was widened.
typedef struct {
  double column[3], u[3], widen;
  int32_t changed; // by the last fan
} CwLean;

// What all blocks share. The vertices in reach are divided into blocks along the curve of the domain's tree. A block is
// solved together with the vertices up to HALO edges around it, whose displacement counts in their own block alone: the
// solution forgets within a few edges what it was held to beyond them, and the next fan goes on from what all have
// found. Sources, reach and blocks are those of the first fan, when no height is greater.
typedef struct CwFans {
  const CwLayerWork *work;
  int32_t source_count;
  CwFanSource *source; // in order of their vertices
  CwFanReach *reach;
  int32_t *local;          // scratch of a block: local number + 1 of every vertex of the domain, else 0
  int32_t count;           // vertices in reach that may lean
  int32_t *member, *place; // these, block by block; the place of each vertex among them, -1: none of them
  int32_t block_count;
  void **lean;    // the CwLean of the members of each block, as the last fan left them; NULL before the first
  double *lean_t; // of each vertex: the height it was made for; negative out of reach
} CwFans;

// layers_fan_reach.c: sets `reach` from the sources. Collective.
CwStatus cw_fan_find_reach(CwFans *fans);

// Members of a block.
int32_t cw_fan_block_size(const CwFans *fans, int32_t block);

// Solves one block: a task (CwTask) over CwFans; gives the CwLean of its members.
CwStatus cw_fan_solve_block(void *fans, int32_t block, void **bytes, int64_t *size);

#endif
