// SPDX-License-Identifier: AGPL-3.0-or-later
// Improves tetrahedra with the boundary fixed: edge removal (3-2, 4-4 and larger), face removal (2-3),
// smoothing of inner points, and new points under flat tetrahedra that hang on the boundary. Only tetrahedra
// below a limit of shape, and what lies next to them, are touched.
#ifndef CUTWATER_MESHER_FILL_TET_IMPROVE_H
#define CUTWATER_MESHER_FILL_TET_IMPROVE_H

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/delaunay.h"
#include "mesher/fill/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int32_t edges_removed, faces_removed, points_moved, points_removed, points_added, search_tries, patches_changed;
  double least_before, least_after; // least quality, as cw_tet_quality; 0.4226 where none is below
} CwTetImproved;

// All tetrahedra of *mesh are inside; their faces on the boundary have no neighbour. Points that come from
// the first `fixed_count` given ones stay; `on_plane`, of each of these 1 where it lies on a dividing plane, may be
// NULL. New points have sources from *source_count on, which is counted up. The least quality round any place does not
// fall but for even edges, and then not below 0.3. Deterministic. `improved` may be NULL.
CwStatus cw_tet_improve_mesh(CwDelaunay *mesh, int32_t fixed_count, const uint8_t *on_plane, int32_t *source_count,
                             CwTetImproved *improved);

// The same for a fill whose first `fixed_count` points are those of the boundary. Where it fails *fill is
// empty.
CwStatus cw_tet_improve(int32_t fixed_count, const uint8_t *on_plane, CwFill *fill, CwTetImproved *improved);

#ifdef __cplusplus
}
#endif
#endif
