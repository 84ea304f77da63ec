// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/surface.h"

#include <stdlib.h>
#include <string.h>

static void mark(const int32_t *corner, int64_t count, int32_t *marks) {
  for (int64_t k = 0; k < count; k++) marks[corner[k]] = 1;
}

static void renumber(const int32_t *corner, int64_t count, const int32_t *number, int32_t *made) {
  for (int64_t k = 0; k < count; k++) made[k] = number[corner[k]];
}

CwStatus cw_surface_of(const CwRegionData *cells, CwRegionData *surface) {
  CwStatus status = CW_OK;
  const size_t triangles = (size_t)cells->triangle_count, quads = (size_t)cells->quad_count;
  int32_t *number = NULL, count = 0; // of each point on a face: first a mark, then its new number
  surface->domain = cells->domain;
  surface->region = cells->region;
  CW_NEW(number, cells->point_count);
  CW_NEW_UNSET(surface->triangles, triangles);
  CW_NEW_UNSET(surface->triangle_patch, triangles);
  CW_NEW_UNSET(surface->quads, quads);
  CW_NEW_UNSET(surface->quad_patch, quads);
  mark((const int32_t *)cells->triangles, 3 * (int64_t)triangles, number);
  mark((const int32_t *)cells->quads, 4 * (int64_t)quads, number);
  for (int32_t p = 0; p < cells->point_count; p++) count += number[p];
  CW_NEW_UNSET(surface->points, count);
  for (int32_t p = 0; p < cells->point_count; p++) {
    if (!number[p]) continue;
    number[p] = surface->point_count++;
    memcpy(surface->points[number[p]], cells->points[p], sizeof surface->points[0]);
  }
  surface->triangle_count = cells->triangle_count;
  surface->quad_count = cells->quad_count;
  renumber((const int32_t *)cells->triangles, 3 * (int64_t)triangles, number, (int32_t *)surface->triangles);
  renumber((const int32_t *)cells->quads, 4 * (int64_t)quads, number, (int32_t *)surface->quads);
  memcpy(surface->triangle_patch, cells->triangle_patch, triangles * sizeof *surface->triangle_patch);
  memcpy(surface->quad_patch, cells->quad_patch, quads * sizeof *surface->quad_patch);
done:
  free(number);
  return status;
}
