// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the nodes of a column lie: on the line from the wall to the layer top, and on a cap (a non-wall patch) on its
// exact surface. On a curved cap the line is a chord: between wall and top it would leave the surface.
#ifndef CUTWATER_MESHER_REGION_COLUMN_PLACE_H
#define CUTWATER_MESHER_REGION_COLUMN_PLACE_H

#include "mesher/skeleton/skeleton.h"

// (u,v) on a cap of a wall vertex on its rim: the start of the search for the nodes above it.
typedef struct {
  int32_t vertex, face;
  double uv[2];
} CwRimPlace;

typedef struct {
  int32_t count;
  CwRimPlace *place; // by ascending vertex and face
} CwRimPlaces;

// [out] places: of all rims of the skeleton's walls; cw_rim_places_free.
CwStatus cw_rim_places_make(const CwSkeleton *skeleton, CwRimPlaces *places);
void cw_rim_places_free(CwRimPlaces *places);

// The node at `share` (0..1) of the height of the column of a wall vertex.
void cw_column_place(const CwSkeleton *skeleton, const CwRimPlaces *places, int32_t vertex, double share, double x[3]);

#endif
