// SPDX-License-Identifier: AGPL-3.0-or-later
// Edge flips of wall and front together. The front inherits the triangles of the wall, and where columns lean (beside
// creases, round noses) they come out stretched: four front vertices that lie almost in a plane with the wrong diagonal
// between them force a flat tetrahedron on any filler. Turning the diagonal of both triangulations mends it.
#ifndef CUTWATER_MESHER_LAYERS_FRONT_FLIP_H
#define CUTWATER_MESHER_LAYERS_FRONT_FLIP_H

#include <stdint.h>

#include "mesher/surface/flip_mesh.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Flips edges between triangles of equal `group`, not below 0, where that raises the least angle of the front, keeps
// the wall's triangles fair and flat, and leaves the thick prisms valid. Changes `mesh` in place; *flips counts.
// Deterministic. Collective.
CwStatus cw_front_flip(const double (*wall)[3], const double (*front)[3], int32_t triangle_count, CwFlipMesh *mesh,
                       const int64_t *group, int32_t *flips);

#ifdef __cplusplus
}
#endif
#endif
