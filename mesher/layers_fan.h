// SPDX-License-Identifier: AGPL-3.0-or-later
// What the two halves of the fan share: layers_fan.c finds its sources and what they reach, layers_fan_block.c solves it.
#ifndef CUTWATER_MESHER_LAYERS_FAN_H
#define CUTWATER_MESHER_LAYERS_FAN_H

#include "mesher/layers_inner.h"

enum { CW_FAN_BLOCK = 4096 }; // vertices

// Of a direction that a column may lean in.
#define CW_FAN_LEAST_COSINE 0.3

// Of every vertex: the nearest source.
typedef struct {
  double distance, opening, height; // to it, its cot(alpha/2) and height
  int32_t source;                   // place in the list; -1: out of reach
} CwFanReach;

// A vertex whose column is given.
typedef struct {
  int32_t vertex;
  double u[3], line[3]; // displacement relative to an undisturbed neighbour, m; direction in which it may still lean
} CwFanSource;

// What all blocks share. The vertices in reach are divided into blocks along the curve of the domain's tree. A block is
// solved together with the vertices up to HALO edges around it, whose displacement counts in their own block alone: the
// solution forgets within a few edges what it was held to beyond them, and the next fan goes on from what all have found.
typedef struct {
  const CwLayerWork *work;
  CwFanReach *reach;
  CwFanSource *source;
  int32_t *local;               // scratch of a block: local number + 1 of every vertex of the domain, else 0
  int32_t count, *order;        // vertices in reach, in order of distance from their sources
  int32_t *place;               // of each vertex in `order`; -1: out of reach
  int32_t *member, *block;      // the same vertices, block by block; of each vertex, -1: out of reach
} CwFans;

// Members of a block.
int32_t cw_fan_block_size(const CwFans *fans, int32_t block);

// Solves one block: a task (CwTask) over CwFans; gives the CwLean of its members.
CwStatus cw_fan_solve_block(void *fans, int32_t block, void **bytes, int64_t *size);

#endif
