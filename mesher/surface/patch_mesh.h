// SPDX-License-Identifier: AGPL-3.0-or-later
// Meshes one surface patch in its parameter plane under the metric of the surface and a size field in space.
// The same code serves CAD faces, open patches inside marched open edges, and partition planes (where the map is
// linear).
//
//   boundary points and edges in (u,v)  ->  constrained Delaunay (cdt.h)  ->  points in rows (patch_front.h)
//     ->  flip, split, remove, smooth (patch_improve.h)  ->  triangles
//
// Boundary points and edges are kept exactly: they are shared with other patches.
#pragma once

#include <stdint.h>

#include "mesher/parallel/outcome.h"
#include "mesher/surface/patch_input.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int32_t point_count, triangle_count;
  double (*uv)[2], (*x)[3]; // the given points first, in their order
  int32_t (*triangle)[3];   // counter-clockwise in (u,v)
  int32_t *component;       // of each triangle: pieces that the given edges cut the patch into, numbered from 0
                            // by the smallest given points on them
  int32_t component_count;
} CwPatchMesh;

// Fails with CW_ERR_MESH where the boundary is open, naming the patch and the coordinates. Outcome: that of
// cw_cdt_make where edges cross. Deterministic: equal input gives equal bits.
CwStatus cw_patch_mesh(const CwPatchInput *input, CwPatchMesh *mesh, CwOutcome *outcome);
void cw_patch_mesh_free(CwPatchMesh *mesh);

#ifdef __cplusplus
}
#endif
