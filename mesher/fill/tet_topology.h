// SPDX-License-Identifier: AGPL-3.0-or-later
// Adjacency in a mesh of tetrahedra: stars of points, rings of edges, and the exchange of what fills a cavity.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/common/tet.h"
#include "mesher/fill/tet_mesh.h"

enum { CW_CAVITY = 48 }; // tetrahedra that are put into a cavity at once, at most

// Tetrahedra of a point, from t on, which has it, into star; 0 where there are more than `most`.
int cw_tet_star(CwTetMesh *mesh, int32_t t, int32_t point, int most, int32_t *star);

// Tetrahedra round the edge a-b of t: tet[k] has the points ring[k], ring[k + 1], and (a, b, ring[k], ring[k + 1]) is
// positive. 0 where there are more than `most`, or the edge is open.
int cw_tet_ring(const CwTetMesh *mesh, int32_t t, int32_t a, int32_t b, int most, int32_t *tet, int32_t *ring);
// Whether that gives three or four: from t and its two neighbours at the edge alone, which takes a fraction of the
// time.
int cw_tet_ring_is_short(const CwTetMesh *mesh, int32_t t, int32_t a, int32_t b);

// A face by its points, the least and the greatest of which are together one number.
typedef struct {
  uint64_t ends;
  int32_t middle, owner; // 4 * tetrahedron + face
} CwTetSide;

static inline CwTetSide cw_side_of(int32_t a, int32_t b, int32_t c, int32_t owner) {
  int32_t low = a < b ? a : b, high = a < b ? b : a, least = low < c ? low : c, most = high > c ? high : c;
  return (CwTetSide){(uint64_t)(uint32_t)least << 32 | (uint32_t)most, a ^ b ^ c ^ least ^ most, owner};
}

// Face i of a tetrahedron with these corners.
static inline CwTetSide cw_tet_side(const int32_t corner[4], int i, int32_t owner) {
  const int8_t *face = cw_tet_face[i];
  return cw_side_of(corner[face[0]], corner[face[1]], corner[face[2]], owner);
}

// Faces in an order of their points, for qsort and bsearch.
int cw_tet_sides_compare(const void *left, const void *right);

// Puts `count` tetrahedra in the place of the `old_count` ones, which fill the same cavity; slot[k] is where each is
// now. Fails (CW_ERR_FAULT) where they do not have the same hull.
CwStatus cw_tet_exchange(CwTetMesh *mesh, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                         int32_t *slot);
