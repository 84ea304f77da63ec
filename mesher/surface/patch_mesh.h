// SPDX-License-Identifier: AGPL-3.0-or-later
// Meshes one surface patch in its parameter plane under the metric of the surface and a size field in space.
// The same code serves CAD faces, open patches inside marched open edges, and partition planes (where the map is
// linear).
//
//   boundary points and edges in (u,v)  ->  constrained Delaunay (cdt.h)  ->  points in rows (patch_front.h)
//     ->  flip, split, remove, smooth (patch_improve.h)  ->  triangles
//
// Boundary points and edges are kept exactly: they are shared with other patches.
#ifndef CUTWATER_MESHER_SURFACE_PATCH_MESH_H
#define CUTWATER_MESHER_SURFACE_PATCH_MESH_H

#include <stdint.h>

#include "mesher/common/size_at.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Point and first derivatives of the surface at (u,v), m. xu and xv may be NULL. It is asked inside of the
// polygon of the given edges only.
typedef void (*CwSurfaceAt)(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]);

typedef struct {
  CwSurfaceAt surface;
  const void *surface_context;
  CwSizeAt size;
  const void *size_context;
  int32_t point_count; // given points, all on edges
  const double (*uv)[2];
  const double (*x)[3]; // exact positions of the given points (the map may differ by rounding)
  int32_t edge_count;
  const int32_t (*edge)[2];
  const uint8_t *boundary; // 1: bounds the patch (inside is by parity); 0: lies in it
  const char *name;        // for messages
  double largest;          // m: triangles larger than the equilateral one with such edges are halved where shorter
                           // ones are wanted; 0: none
} CwPatchInput;

typedef struct {
  int32_t point_count, triangle_count;
  double (*uv)[2], (*x)[3]; // the given points first, in their order
  int32_t (*triangle)[3];   // counter-clockwise in (u,v)
  int32_t *component;       // of each triangle: pieces that the given edges cut the patch into, numbered from 0
                            // by the smallest given points on them
  int32_t component_count;
  // Triangles whose normal in space is against xu x xv: 0 unless the given points force them (a boundary much
  // coarser than the curvature). `folded_at`: the middle of the first one. The caller judges whether it can
  // live with them.
  int32_t folded_count;
  double folded_at[3];
} CwPatchMesh;

// Fails with CW_ERR_MESH where edges cross or the boundary is open, naming the patch and the coordinates.
// Deterministic: equal input gives equal bits.
CwStatus cw_patch_mesh(const CwPatchInput *input, CwPatchMesh *mesh);
void cw_patch_mesh_free(CwPatchMesh *mesh);

#ifdef __cplusplus
}
#endif
#endif
