// SPDX-License-Identifier: AGPL-3.0-or-later
// Mends walls that are folded at a vertex: where triangles are as wide as the nose that they follow, one of them may
// stand against its neighbours, and no column sees all faces. Turning edges there opens the fold.
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "mesher/surface/flip_mesh.h"
#include "pipeline/status.h"

// Flips edges between triangles of equal `group` around vertices whose faces have no direction in common with a cosine
// of at least column_least_cosine, where that raises the least such cosine of the four vertices concerned; triangles of
// a group below 0 stay. Normals point out of the domain. Changes `mesh` in place; *flips counts, *folded: vertices
// still below. Deterministic. Collective.
CwStatus cw_wall_unfold(const CwContext *context, int32_t point_count, const double (*x)[3], int32_t triangle_count,
                        CwFlipMesh *mesh, const int64_t *group, int32_t *flips, int32_t *folded);
