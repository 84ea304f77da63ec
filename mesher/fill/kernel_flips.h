// SPDX-License-Identifier: AGPL-3.0-or-later
// Flips of a finished Delaunay mesh with exact validity: 2-3 and the removal of an edge with any ring (3-2,
// 4-4, ...). A flip is done where it lowers a count of crossings that the caller gives.
#ifndef CUTWATER_MESHER_FILL_KERNEL_FLIPS_H
#define CUTWATER_MESHER_FILL_KERNEL_FLIPS_H

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/delaunay.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_RING = 24, CW_FLIP = 2 * CW_RING }; // tetrahedra round an edge that is removed, and in a flip, at most

// How much the edge (count = 2) or face (count = 3) with these points is in the way; 0: not at all.
typedef int (*CwCrossing)(const void *context, int count, const int32_t *point);

typedef struct {
  CwDelaunay *mesh;
  int32_t *tet_at; // one tetrahedron of each point; not kept where it is NULL
  uint64_t stamp;  // of the last star, and of its tetrahedra
  int32_t *star, star_count, star_space;
  CwCrossing crossing;
  const void *context;
  int slack;    // crossings that a flip may add
  int64_t done; // flips
} CwFlips;

CwStatus cw_flips_make(CwDelaunay *mesh, CwFlips *flips);
void cw_flips_free(CwFlips *flips);

// A new point, in no tetrahedron yet.
CwStatus cw_flips_add_point(CwFlips *flips, const double x[3], int32_t source, int32_t *point);

// Tetrahedra of a point, into flips->star.
CwStatus cw_flips_star(CwFlips *flips, int32_t point);
// A tetrahedron with both points, -1 where they have no edge. Overwrites flips->star.
CwStatus cw_flips_find_edge(CwFlips *flips, int32_t a, int32_t b, int32_t *tet);
// Tetrahedra round the edge a-b of t: tet[k] has the points ring[k], ring[k + 1], and (a, b, ring[k], ring[k
// + 1]) is positive. 0 where there are more than CW_RING, or the edge is open.
int cw_flips_ring(const CwFlips *flips, int32_t t, int32_t a, int32_t b, int most, int32_t *tet, int32_t *ring);
// Whether that gives three or four: from t and its two neighbours at the edge alone, which takes a fraction of the
// time.
int cw_flips_is_short(const CwFlips *flips, int32_t t, int32_t a, int32_t b);

// Two tetrahedra at face i of t become three. *flipped is 0 where that is not valid, or adds crossings.
CwStatus cw_flips_face(CwFlips *flips, int32_t t, int i, int *flipped);
// Takes the edge a-b of t away; of all valid ways the one with the fewest crossings. *flipped as above.
CwStatus cw_flips_edge(CwFlips *flips, int32_t t, int32_t a, int32_t b, int *flipped);

// Puts `count` tetrahedra in the place of the `old_count` ones, which fill the same cavity; slot[k] is where
// each is now.
CwStatus cw_flips_replace(CwFlips *flips, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                          int32_t *slot);

#ifdef __cplusplus
}
#endif
#endif
