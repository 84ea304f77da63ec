// SPDX-License-Identifier: AGPL-3.0-or-later
// The boundary triangles (facets) in a Delaunay mesh: which of its faces they are, and what to leave alone.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/delaunay.h"
#include "mesher/fill/fill.h"

typedef struct {
  int32_t count;
  int32_t (*corner)[3]; // points of the Delaunay mesh; normal out of the region
  int32_t *inner;       // 4 * tetrahedron + face: the face of each facet, seen from inside; -1: missing
  int32_t missing_count;
  int32_t *table; // hash table of facets by their points; -1: empty
  int32_t *edge;  // hash table of their edges, as 3 * facet + side of one facet that has it upward; -1: empty
  uint32_t table_capacity, edge_capacity;
} CwFacets;

// Numbers the facets as the mesh does. Fails with CW_ERR_MESH where one is listed twice.
CwStatus cw_facets_make(const CwFillInput *input, const CwTetMesh *mesh, CwFacets *facets);
void cw_facets_free(CwFacets *facets);

// The facet with these points in any order, or -1.
int32_t cw_facets_find(const CwFacets *facets, const int32_t corner[3]);
// True where the two points are an edge of the boundary.
int cw_facets_has_edge(const CwFacets *facets, int32_t a, int32_t b);

// Looks all faces of the mesh up: fills inner and missing_count.
CwStatus cw_facets_locate(const CwTetMesh *mesh, int32_t boundary_points, CwFacets *facets);
