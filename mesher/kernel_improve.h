// SPDX-License-Identifier: AGPL-3.0-or-later
// Improves the tetrahedra of a region where they stand in the Delaunay mesh: the changes of tet_improve (edge
// removal, face removal, smoothing, new points under flat tetrahedra), on the few that are bad and what lies
// next to them.
#ifndef CUTWATER_MESHER_KERNEL_IMPROVE_H
#define CUTWATER_MESHER_KERNEL_IMPROVE_H

#include "mesher/delaunay.h"
#include "mesher/tet_improve.h"

#ifdef __cplusplus
extern "C" {
#endif

// All tetrahedra of *mesh are inside; their faces on the boundary have no neighbour. Points that come from
// the first `fixed_count` given ones stay. New points have sources from `source_count` on, which is counted
// up. The least quality round any place never falls. Deterministic.
CwStatus cw_kernel_improve(CwDelaunay *mesh, int32_t fixed_count, int32_t *source_count,
                           CwTetImproved *improved);

#ifdef __cplusplus
}
#endif
#endif
