// SPDX-License-Identifier: AGPL-3.0-or-later
// What a boundary allows the tetrahedra that fill it, whoever fills it and with whatever points inside.
#ifndef CUTWATER_MESHER_FILL_TET_BOUND_H
#define CUTWATER_MESHER_FILL_TET_BOUND_H

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CW_TET_BOUND_MOST 45.0 // degrees; no bound above it is looked for

// No filling that keeps the triangles of the closed boundary whole has a least dihedral angle above *degrees. At an
// edge of the boundary with the inner angle A stands one tetrahedron, which is then that of the edge's two triangles,
// or there are more, and one of them has A/2 or less. So the tetrahedron on a triangle has the corner of a neighbour
// across an edge as its fourth, is known, and the other edges (but those whose neighbours have the same corner) have
// two tetrahedra or more; or all three edges have. The bound is the best of these four, for the worst triangle: *worst,
// -1 where it is CW_TET_BOUND_MOST. Edges with more than two triangles bound nothing. Normals point outward, as in a
// fill.
CwStatus cw_tet_bound(const CwFillInput *boundary, double *degrees, int32_t *worst);

#ifdef __cplusplus
}
#endif
#endif
