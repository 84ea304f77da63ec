// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_boundary.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"

typedef struct {
  const CwBoundary *boundary;
  CwRegionBoundary *inner;
  int32_t *local; // of each boundary node
} Gathering;

static int32_t local_of(Gathering *gathering, int32_t node) {
  CwRegionBoundary *inner = gathering->inner;
  if (gathering->local[node] < 0) {
    gathering->local[node] = inner->node_count;
    cw_copy(gathering->boundary->interfaces.nodes.x[node], inner->x[inner->node_count]);
    inner->node[inner->node_count++] = node;
  }
  return gathering->local[node];
}

static void add(Gathering *gathering, int32_t *count, const int32_t corner[3], int turned, int32_t source) {
  CwRegionBoundary *inner = gathering->inner;
  int32_t at = inner->wall_count + inner->open_patch_count + inner->interface_count;
  for (int k = 0; k < 3; k++) inner->triangle[at][k] = local_of(gathering, corner[turned ? 2 - k : k]);
  inner->source[at] = source;
  ++*count;
}

CwStatus cw_region_boundary_make(const CwBoundary *boundary, int32_t region, int planned, CwRegionBoundary *inner) {
  CwStatus status = CW_OK;
  Gathering gathering = {boundary, inner, NULL};
  planned = planned && boundary->interfaces.planned.triangle;
  int32_t interfaces = planned ? boundary->interfaces.planned.count : boundary->interfaces.refined.count;
  int32_t wall_start = boundary->surface.region_start[region], wall_end = boundary->surface.region_start[region + 1];
  int32_t count = wall_end - wall_start;
  const int32_t(*triangle)[3] =
      (const int32_t(*)[3])(planned ? boundary->interfaces.planned.triangle : boundary->interfaces.refined.triangle);
  const int32_t(*beside)[2] =
      (const int32_t(*)[2])(planned ? boundary->interfaces.planned.region : boundary->interfaces.refined.region);
  *inner = (CwRegionBoundary){0};
  for (int32_t t = 0; t < boundary->interfaces.open_patch.count; t++)
    count += boundary->interfaces.open_patch.region[t] == region;
  for (int32_t t = 0; t < interfaces; t++) count += beside[t][0] == region || beside[t][1] == region;
  CW_NEW(inner->triangle, count);
  CW_NEW(inner->source, count);
  CW_NEW(inner->node, 3 * (size_t)count);
  CW_NEW(inner->x, 3 * (size_t)count);
  CW_NEW(gathering.local, boundary->interfaces.nodes.count);
  memset(gathering.local, -1, (size_t)boundary->interfaces.nodes.count * sizeof *gathering.local);
  for (int32_t i = wall_start; i < wall_end; i++) {
    int32_t t = boundary->surface.region_triangle[i];
    add(&gathering, &inner->wall_count, boundary->layers.triangle[t], 0, t);
  }
  for (int32_t t = 0; t < boundary->interfaces.open_patch.count; t++) {
    if (boundary->interfaces.open_patch.region[t] == region)
      add(&gathering, &inner->open_patch_count, boundary->interfaces.open_patch.triangle[t], 0, t);
  }
  for (int32_t t = 0; t < interfaces; t++) {
    for (int side = 0; side < 2; side++) {
      if (beside[t][side] == region) add(&gathering, &inner->interface_count, triangle[t], side, t);
    }
  }
done:
  free(gathering.local);
  if (status != CW_OK) cw_region_boundary_free(inner);
  return status;
}

void cw_region_boundary_free(CwRegionBoundary *inner) {
  free(inner->triangle);
  free(inner->source);
  free(inner->node);
  free(inner->x);
  *inner = (CwRegionBoundary){0};
}

CwFillInput cw_region_fill_input(const CwBoundary *boundary, const CwRegionBoundary *inner, const char *name) {
  return (CwFillInput){.point_count = inner->node_count,
                       .x = (const double(*)[3])inner->x,
                       .triangle_count = inner->wall_count + inner->open_patch_count + inner->interface_count,
                       .triangle = (const int32_t(*)[3])inner->triangle,
                       .size = boundary->size_at,
                       .size_context = boundary->size,
                       .name = name,
                       .offset_count = inner->wall_count + inner->open_patch_count + inner->interface_count,
                       .interface_count = inner->interface_count,
                       .bare_first = inner->wall_count,
                       .bare_count = inner->open_patch_count};
}
