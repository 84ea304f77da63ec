// SPDX-License-Identifier: AGPL-3.0-or-later
// The boundary of a region by itself, and its faces of both kinds seen alike.
#pragma once

#include "pipeline/mesh/region_items.h"

// The boundary faces of a region with their patches, in their order, and the points of these faces alone, in theirs:
// what is looked at once for each picture lies close together in memory. Zeroed `surface` on entry; free it with
// cw_mesh_region_free, also after a failure. CW_ERR_MEMORY.
CwStatus cw_surface_of(const CwRegionData *cells, CwRegionData *surface);

typedef struct {
  const int32_t *corner;
  const double *x[4];
  int count, patch; // corners: 3 or 4; patch: of its domain
} CwSurfaceFace;

static inline int32_t cw_surface_face_count(const CwRegionData *surface) {
  return surface->triangle_count + surface->quad_count;
}

// Face `index` of these, triangles before quadrilaterals.
static inline CwSurfaceFace cw_surface_face(const CwRegionData *surface, int32_t index) {
  const int32_t quad = index - surface->triangle_count;
  CwSurfaceFace face = {.count = quad < 0 ? 3 : 4};
  face.corner = quad < 0 ? surface->triangles[index] : surface->quads[quad];
  face.patch = quad < 0 ? surface->triangle_patch[index] : surface->quad_patch[quad];
  for (int k = 0; k < face.count; k++) face.x[k] = surface->points[face.corner[k]];
  return face;
}
