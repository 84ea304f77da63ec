// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the nodes of a column lie: on the line from the wall to the layer top, and on an open patch (a non-wall patch)
// on its exact surface. On a curved open patch the line is a chord: between wall and top it would leave the surface.
#pragma once

#include "mesher/region/region_input.h"

// (u,v) on an open patch of a wall vertex on its open edge: the start of the search for the nodes above it.
typedef struct {
  int32_t vertex, face;
  double uv[2];
} CwOpenEdgePlace;

// A wall edge on an open patch: the side of the columns over it is a face of the patch.
typedef struct {
  int32_t low, high, face; // vertices, low < high
} CwOpenEdgeSide;

typedef struct {
  int32_t count, side_count;
  CwOpenEdgePlace *place; // by ascending vertex and face
  CwOpenEdgeSide *side;   // by ascending vertices
} CwOpenEdgePlaces;

// [out] places: of all open edges of the boundary's walls; cw_open_edge_places_free.
CwStatus cw_open_edge_places_make(const CwRegionInput *from, CwOpenEdgePlaces *places);
void cw_open_edge_places_free(CwOpenEdgePlaces *places);

// The open patch that the wall edge from a to b lies on, -1: none.
int32_t cw_open_edge_face(const CwOpenEdgePlaces *places, int32_t a, int32_t b);

// The node at `share` (0..1) of the thickness of the column of a wall vertex.
void cw_column_place(const CwRegionInput *from, const CwOpenEdgePlaces *places, int32_t vertex, double share,
                     double x[3]);
