// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/vertex_map.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/mix.h"

enum { LEAST = 64 }; // places

// Where a vertex stands, or where it would.
static CwVertexNumber *find(const CwVertexMap *map, int32_t vertex) {
  uint32_t last = (uint32_t)map->capacity - 1, at = (uint32_t)cw_mix((uint64_t)vertex) & last;
  while (map->item[at].number && map->item[at].vertex != vertex) at = (at + 1) & last;
  return &map->item[at];
}

int32_t cw_vertex_map_get(const CwVertexMap *map, int32_t vertex) {
  return map->count ? find(map, vertex)->number : 0;
}

// Half of the places stay free, so that few are looked at.
static CwStatus widen(CwVertexMap *map) {
  CwStatus status = CW_OK;
  CwVertexMap wider = {.count = map->count, .capacity = map->capacity ? 2 * map->capacity : LEAST};
  CW_NEW(wider.item, wider.capacity);
  for (int32_t i = 0; i < map->capacity; i++) {
    if (map->item[i].number) *find(&wider, map->item[i].vertex) = map->item[i];
  }
  free(map->item);
  *map = wider;
done:
  return status;
}

CwStatus cw_vertex_map_set(CwVertexMap *map, int32_t vertex, int32_t number) {
  CwStatus status = CW_OK;
  if (2 * map->count >= map->capacity) CW_TRY(widen(map));
  CwVertexNumber *item = find(map, vertex);
  map->count += !item->number;
  *item = (CwVertexNumber){vertex, number};
done:
  return status;
}

void cw_vertex_map_free(CwVertexMap *map) {
  free(map->item);
  memset(map, 0, sizeof *map);
}
