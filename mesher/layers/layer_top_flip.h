// SPDX-License-Identifier: AGPL-3.0-or-later
// Edge flips of wall and layer top together. The layer top inherits the triangles of the wall, and where columns lean
// (beside creases, round noses) they come out stretched: four layer top vertices that lie almost in a plane with the
// wrong diagonal between them force a flat tetrahedron on any filler. Turning the diagonal of both triangulations mends
// it.
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "mesher/surface/flip_mesh.h"
#include "pipeline/status.h"

// Flips edges between triangles of equal `group`, not below 0, where that raises the least angle of the layer top
// and leaves neither triangle small beside the other, keeps the wall flat, and leaves the thick prisms valid. Changes
// `mesh` in place; *flips counts. Deterministic. Collective.
CwStatus cw_layer_top_flip(const CwContext *context, const double (*wall)[3], const double (*top)[3],
                           int32_t triangle_count, CwFlipMesh *mesh, const int64_t *group, int32_t *flips);
