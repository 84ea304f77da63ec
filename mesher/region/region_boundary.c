// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_boundary.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/common/vtk.h"

typedef struct {
  const CwRegionInput *from;
  CwRegionBoundary *inner;
  int32_t *local; // of each boundary node
} Gathering;

static int32_t local_of(Gathering *gathering, int32_t node) {
  CwRegionBoundary *inner = gathering->inner;
  if (gathering->local[node] < 0) {
    gathering->local[node] = inner->node_count;
    cw_copy(gathering->from->interfaces->nodes.x[node], inner->x[inner->node_count]);
    inner->node[inner->node_count++] = node;
  }
  return gathering->local[node];
}

static int32_t count_of(const CwRegionBoundary *inner) {
  return inner->wall_count + inner->bare_count + inner->open_patch_count + inner->interface_count;
}

static void add(Gathering *gathering, int32_t *count, const int32_t corner[3], int turned, int32_t source) {
  CwRegionBoundary *inner = gathering->inner;
  int32_t at = count_of(inner);
  for (int k = 0; k < 3; k++) inner->triangle[at][k] = local_of(gathering, corner[turned ? 2 - k : k]);
  inner->source[at] = source;
  ++*count;
}

CwStatus cw_region_boundary_make(const CwRegionInput *from, int32_t region, int planned, CwRegionBoundary *inner) {
  CwStatus status = CW_OK;
  Gathering gathering = {from, inner, NULL};
  const CwOpenPatches *open_patch = &from->interfaces->open_patch;
  const CwInterfaceTriangles *on_planes = cw_interfaces_of(from->interfaces, planned);
  int32_t wall_start = from->surface->region_start[region], wall_end = from->surface->region_start[region + 1];
  int32_t count = wall_end - wall_start;
  *inner = (CwRegionBoundary){0};
  for (int32_t t = 0; t < open_patch->count; t++) count += open_patch->region[t] == region;
  for (int32_t t = 0; t < on_planes->count; t++)
    count += on_planes->region[t][0] == region || on_planes->region[t][1] == region;
  CW_NEW(inner->triangle, count);
  CW_NEW(inner->source, count);
  CW_NEW(inner->node, 3 * (size_t)count);
  CW_NEW(inner->x, 3 * (size_t)count);
  CW_NEW(gathering.local, from->interfaces->nodes.count);
  memset(gathering.local, -1, (size_t)from->interfaces->nodes.count * sizeof *gathering.local);
  for (int bare = 0; bare < 2; bare++)
    for (int32_t i = wall_start; i < wall_end; i++) {
      int32_t t = from->surface->region_triangle[i];
      if ((cw_layers_pinched(from->layers, t) == 3) != bare) continue;
      add(&gathering, bare ? &inner->bare_count : &inner->wall_count, from->layers->triangle[t], 0, t);
    }
  for (int32_t t = 0; t < open_patch->count; t++)
    if (open_patch->region[t] == region) add(&gathering, &inner->open_patch_count, open_patch->triangle[t], 0, t);
  for (int32_t t = 0; t < on_planes->count; t++) {
    for (int side = 0; side < 2; side++)
      if (on_planes->region[t][side] == region)
        add(&gathering, &inner->interface_count, on_planes->triangle[t], side, t);
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

CwFillInput cw_region_fill_input(const CwRegionInput *from, const CwRegionBoundary *inner, const char *name) {
  return (CwFillInput){.point_count = inner->node_count,
                       .x = (const double(*)[3])inner->x,
                       .triangle_count = count_of(inner),
                       .triangle = (const int32_t(*)[3])inner->triangle,
                       .size = from->in->size_at,
                       .size_context = from->in->size,
                       .name = name,
                       .log = from->log,
                       .offset_count = count_of(inner),
                       .interface_count = inner->interface_count,
                       .bare_first = inner->wall_count,
                       .bare_count = inner->bare_count + inner->open_patch_count};
}

CwStatus cw_region_boundary_vtk(const CwRegionBoundary *inner, const int32_t *crossing, const char *title,
                                const char *path) {
  CwStatus status = CW_OK;
  int32_t count = count_of(inner), *surface = NULL;
  CW_NEW(surface, count);
  for (int32_t t = inner->wall_count; t < count; t++) surface[t] = 1 + (t >= count - inner->interface_count);
  const CwVtkField field[2] = {{"surface", surface, NULL}, {"crossing", crossing, NULL}};
  const CwVtkTriangles triangles = {.title = title,
                                    .point_count = inner->node_count,
                                    .x = (const double(*)[3])inner->x,
                                    .triangle_count = count,
                                    .triangle = (const int32_t(*)[3])inner->triangle,
                                    .field_count = crossing ? 2 : 1,
                                    .field = field};
  CW_TRY(cw_vtk_write(path, &triangles));
done:
  free(surface);
  return status;
}
