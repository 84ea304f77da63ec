// SPDX-License-Identifier: AGPL-3.0-or-later
// Adjacency in a mesh of tetrahedra: stars of points, rings of edges, and the exchange of what fills a cavity.
#ifndef CUTWATER_MESHER_FILL_TET_TOPOLOGY_H
#define CUTWATER_MESHER_FILL_TET_TOPOLOGY_H

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/tet_mesh.h"

enum { CW_CAVITY = 48 }; // tetrahedra that are exchanged at once, at most

// Tetrahedra of a point, from t on, which has it, into star; 0 where there are more than `most`.
int cw_tet_star(CwTetMesh *mesh, int32_t t, int32_t point, int most, int32_t *star);

// Tetrahedra round the edge a-b of t: tet[k] has the points ring[k], ring[k + 1], and (a, b, ring[k], ring[k + 1]) is
// positive. 0 where there are more than `most`, or the edge is open.
int cw_tet_ring(const CwTetMesh *mesh, int32_t t, int32_t a, int32_t b, int most, int32_t *tet, int32_t *ring);
// Whether that gives three or four: from t and its two neighbours at the edge alone, which takes a fraction of the
// time.
int cw_tet_ring_is_short(const CwTetMesh *mesh, int32_t t, int32_t a, int32_t b);

// Puts `count` tetrahedra in the place of the `old_count` ones, which fill the same cavity; slot[k] is where each is
// now. Fails (CW_ERR_MESH) where they do not have the same hull.
CwStatus cw_tet_exchange(CwTetMesh *mesh, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                         int32_t *slot);
#endif
