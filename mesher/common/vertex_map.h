// SPDX-License-Identifier: AGPL-3.0-or-later
// A number for each of some vertices out of many more: a hash table with open addressing, whose memory goes with those
// that have a number alone.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

typedef struct {
  int32_t vertex, number; // 0: none
} CwVertexNumber;

typedef struct {
  int32_t count, capacity; // capacity: a power of two, or 0
  CwVertexNumber *item;
} CwVertexMap; // zeroed before

// The number of a vertex; 0: it has none.
int32_t cw_vertex_map_get(const CwVertexMap *map, int32_t vertex);
// Gives a vertex a number other than 0, or another one than before. CW_ERR_MEMORY.
CwStatus cw_vertex_map_set(CwVertexMap *map, int32_t vertex, int32_t number);
void cw_vertex_map_free(CwVertexMap *map);
