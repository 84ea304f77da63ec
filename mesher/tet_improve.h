// SPDX-License-Identifier: AGPL-3.0-or-later
// Improves tetrahedra with the boundary fixed: edge removal (3-2, 4-4 and larger), face removal (2-3),
// smoothing of inner points, and new points under flat tetrahedra that hang on the boundary. Only tetrahedra
// below a limit of shape are touched.
#ifndef CUTWATER_MESHER_TET_IMPROVE_H
#define CUTWATER_MESHER_TET_IMPROVE_H

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int32_t edges_removed, faces_removed, points_moved, points_added;
  double least_before, least_after; // least sine of a dihedral angle
} CwTetImproved;

// The first `fixed_count` points of *fill keep their numbers and places, and all faces on the boundary stay.
// The least quality round any place never falls. Deterministic. `improved` may be NULL.
CwStatus cw_tet_improve(int32_t fixed_count, CwFill *fill, CwTetImproved *improved);

#ifdef __cplusplus
}
#endif
#endif
