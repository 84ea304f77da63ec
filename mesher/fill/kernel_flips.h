// SPDX-License-Identifier: AGPL-3.0-or-later
// Flips of a finished Delaunay mesh with exact validity: 2-3 and the removal of an edge with any ring (3-2,
// 4-4, ...). A flip is done where it lowers a count of crossings that the caller gives.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/tet_topology.h"

enum { CW_RING = CW_CAVITY / 2 }; // tetrahedra round an edge that is removed, at most

// How many crossings the edge (count = 2) or face (count = 3) with these points has with what is to be recovered.
typedef int (*CwCrossing)(const void *context, int count, const int32_t *point);

typedef struct {
  CwTetMesh *mesh;
  int32_t *tet_at, tet_at_capacity; // one tetrahedron of each point
  int32_t *star, star_count, star_capacity;
  CwCrossing crossing;
  const void *context;
  int slack;    // crossings that a flip may add
  int64_t done; // flips
} CwFlips;

// The mesh stays the caller's; spheres are lost.
CwStatus cw_flips_make(CwTetMesh *mesh, CwFlips *flips);
void cw_flips_free(CwFlips *flips);

// Tetrahedra of a point, into flips->star.
CwStatus cw_flips_star(CwFlips *flips, int32_t point);
// A tetrahedron with both points, -1 where they have no edge. Overwrites flips->star.
CwStatus cw_flips_find_edge(CwFlips *flips, int32_t a, int32_t b, int32_t *tet);

// Two tetrahedra at face i of t become three. *flipped is 0 where that is not valid, or adds crossings.
CwStatus cw_flips_face(CwFlips *flips, int32_t t, int i, int *flipped);
// Takes the edge a-b of t away; of all valid triangulations of its ring the one with the fewest crossings. *flipped as
// above.
CwStatus cw_flips_edge(CwFlips *flips, int32_t t, int32_t a, int32_t b, int *flipped);
// Puts a new point on the edge a-b of t, such a part of the way from a, with the source (*source_count)++. *split is 0
// where rounding or too many tetrahedra forbid it.
CwStatus cw_flips_split(CwFlips *flips, int32_t t, int32_t a, int32_t b, double part, int32_t *source_count,
                        int *split);
