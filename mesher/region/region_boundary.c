// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_boundary.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"

typedef struct {
  const CwSkeleton *skeleton;
  CwRegionBoundary *boundary;
  int32_t *local; // of each skeleton node
} Gathering;

static int32_t local_of(Gathering *gathering, int32_t node) {
  CwRegionBoundary *boundary = gathering->boundary;
  if (gathering->local[node] < 0) {
    gathering->local[node] = boundary->node_count;
    cw_copy(gathering->skeleton->interfaces.nodes.x[node], boundary->x[boundary->node_count]);
    boundary->node[boundary->node_count++] = node;
  }
  return gathering->local[node];
}

static void add(Gathering *gathering, int32_t *count, const int32_t corner[3], int turned, int32_t source) {
  CwRegionBoundary *boundary = gathering->boundary;
  int32_t at = boundary->wall_count + boundary->cap_count + boundary->interface_count;
  for (int k = 0; k < 3; k++) boundary->triangle[at][k] = local_of(gathering, corner[turned ? 2 - k : k]);
  boundary->source[at] = source;
  ++*count;
}

CwStatus cw_region_boundary_make(const CwSkeleton *skeleton, int32_t region, int planned, CwRegionBoundary *boundary) {
  CwStatus status = CW_OK;
  Gathering gathering = {skeleton, boundary, NULL};
  planned = planned && skeleton->interfaces.planned.triangle;
  int32_t interfaces = planned ? skeleton->interfaces.planned.count : skeleton->interfaces.refined.count;
  int32_t wall_start = skeleton->surface.region_start[region], wall_end = skeleton->surface.region_start[region + 1];
  int32_t count = wall_end - wall_start;
  const int32_t(*triangle)[3] =
      (const int32_t(*)[3])(planned ? skeleton->interfaces.planned.triangle : skeleton->interfaces.refined.triangle);
  const int32_t(*beside)[2] =
      (const int32_t(*)[2])(planned ? skeleton->interfaces.planned.region : skeleton->interfaces.refined.region);
  *boundary = (CwRegionBoundary){0};
  for (int32_t t = 0; t < skeleton->interfaces.cap.count; t++) count += skeleton->interfaces.cap.region[t] == region;
  for (int32_t t = 0; t < interfaces; t++) count += beside[t][0] == region || beside[t][1] == region;
  CW_NEW(boundary->triangle, count);
  CW_NEW(boundary->source, count);
  CW_NEW(boundary->node, 3 * (size_t)count);
  CW_NEW(boundary->x, 3 * (size_t)count);
  CW_NEW(gathering.local, skeleton->interfaces.nodes.count);
  memset(gathering.local, -1, (size_t)skeleton->interfaces.nodes.count * sizeof *gathering.local);
  for (int32_t i = wall_start; i < wall_end; i++) {
    int32_t t = skeleton->surface.region_triangle[i];
    add(&gathering, &boundary->wall_count, skeleton->surface.triangle[t], 0, t);
  }
  for (int32_t t = 0; t < skeleton->interfaces.cap.count; t++) {
    if (skeleton->interfaces.cap.region[t] == region)
      add(&gathering, &boundary->cap_count, skeleton->interfaces.cap.triangle[t], 0, t);
  }
  for (int32_t t = 0; t < interfaces; t++) {
    for (int side = 0; side < 2; side++) {
      if (beside[t][side] == region) add(&gathering, &boundary->interface_count, triangle[t], side, t);
    }
  }
done:
  free(gathering.local);
  if (status != CW_OK) cw_region_boundary_free(boundary);
  return status;
}

void cw_region_boundary_free(CwRegionBoundary *boundary) {
  free(boundary->triangle);
  free(boundary->source);
  free(boundary->node);
  free(boundary->x);
  *boundary = (CwRegionBoundary){0};
}

CwFillInput cw_region_fill_input(const CwSkeleton *skeleton, const CwRegionBoundary *boundary, const char *name) {
  return (CwFillInput){.point_count = boundary->node_count,
                       .x = (const double(*)[3])boundary->x,
                       .triangle_count = boundary->wall_count + boundary->cap_count + boundary->interface_count,
                       .triangle = (const int32_t(*)[3])boundary->triangle,
                       .size = skeleton->size_at,
                       .size_context = skeleton->size,
                       .name = name,
                       .offset_count = boundary->wall_count + boundary->cap_count + boundary->interface_count,
                       .interface_count = boundary->interface_count,
                       .bare_first = boundary->wall_count,
                       .bare_count = boundary->cap_count};
}
