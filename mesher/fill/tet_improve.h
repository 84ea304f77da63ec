// SPDX-License-Identifier: AGPL-3.0-or-later
// Improves tetrahedra with the boundary fixed. In this order: single changes (tet_loop.h); for the aspect, moves of all
// points at once (tet_relax.h) and removal of long edges (tet_shorten.h); single changes again, and the same for
// the aspect; for the last ones, the search of patches (tet_search.h). What is well shaped stays as it is.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/fill.h"
#include "mesher/fill/tet_mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

// All tetrahedra of *mesh are inside; their faces on the boundary have no neighbour. Points that come from the first
// `fixed_count` given ones stay. New points have sources from *source_count on, which is counted up. The least quality
// round any place does not fall but for even edges, and then not below sound_quality (policy_table.h). Deterministic.
CwStatus cw_tet_improve_mesh(CwTetMesh *mesh, int32_t fixed_count, int32_t *source_count, CwTetChanges *changes);

// The same for a fill whose first `fixed_count` points are those of the boundary. Where it fails *fill is
// empty.
CwStatus cw_tet_improve(int32_t fixed_count, CwFill *fill, CwTetChanges *changes);

#ifdef __cplusplus
}
#endif
