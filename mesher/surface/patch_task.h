// SPDX-License-Identifier: AGPL-3.0-or-later
// One surface patch as a task: gathers the points and edges that bound it, meshes it, and packs the result so that
// it can travel between ranks.
#pragma once

#include "mesher/surface/patch_mesh.h"

// Points and edges of a patch, gathered curve by curve; `node` maps local points to the numbers of the caller.
typedef struct {
  int32_t point_count, edge_count;
  int32_t *node, node_capacity;
  double (*uv)[2], (*x)[3];
  int32_t uv_capacity, x_capacity;
  int32_t (*edge)[2], edge_capacity;
  uint8_t *boundary;
  int32_t boundary_capacity;
  int32_t *local; // of each node of the caller, -1: not in the patch
} CwPatchOutline;

CwStatus cw_outline_start(CwPatchOutline *outline, int32_t node_count);
// Empties it, for another patch of the same nodes.
void cw_outline_clear(CwPatchOutline *outline);
// Adds the point of `node` unless it is there; returns its local number through *local.
CwStatus cw_outline_point(CwPatchOutline *outline, int32_t node, const double uv[2], const double x[3], int32_t *local);
CwStatus cw_outline_edge(CwPatchOutline *outline, int32_t a, int32_t b, int boundary);
// The same along a curve: the next point, and the edge from *previous, the local number of the one before, -1: none.
CwStatus cw_outline_next(CwPatchOutline *outline, int32_t node, const double uv[2], const double x[3], int boundary,
                         int32_t *previous);
void cw_outline_free(CwPatchOutline *outline);

// A patch mesh in one block: what the caller adds to its own arrays. Points are the new ones only; triangles count
// the outline's points first, then the new ones.
typedef struct {
  CwOutcome outcome; // else no mesh
  int32_t outline_points, point_count, triangle_count;
  const double (*x)[3];
  const int32_t *outline_node; // of the caller
  const int32_t (*triangle)[3];
  const int32_t *label; // of each triangle: region, say
} CwPatchBlock;

// Meshes and packs, with the outcome of cw_patch_mesh; unless that is done, without points or triangles. `largest`: as
// in CwPatchInput. `label` is called with each component's representative point and gives its label. `turned` turns the
// triangles round.
typedef int32_t (*CwLabelAt)(const void *context, const double x[3]);
CwStatus cw_patch_task(const CwPatchOutline *outline, CwSurfaceAt surface, const void *surface_context, CwSizeAt size,
                       const void *size_context, double largest, int turned, CwLabelAt label, const void *label_context,
                       const char *name, void **bytes, int64_t *size_of_bytes);
// Views a packed mesh; the block points into `bytes`.
void cw_patch_block(const void *bytes, CwPatchBlock *block);
