// SPDX-License-Identifier: AGPL-3.0-or-later
#include "chew_fill.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fill/fill_with_fallback.h"
#include "mesher/fill/kernel.h"
#include "mesher/region/tets_on.h"

// Room in the domain's numbering for the inserted points of each interface.
static const int64_t INSERTED_MOST = 1 << 24;

// Counts, and makes room for them.
static CwStatus make_room(int32_t count, const CwChewInterface *interface, const CwChewRegion *region,
                          CwChewSurface *surface) {
  CwStatus status = CW_OK;
  const CwRegionBoundary *inner = &region->inner;
  surface->node_count = inner->node_count;
  surface->wall_count = inner->wall_count;
  surface->fixed_count = surface->triangle_count = inner->wall_count + inner->bare_count + inner->open_patch_count;
  for (int32_t i = 0; i < count; i++) {
    if (interface[i].region[0] != region->region && interface[i].region[1] != region->region) continue;
    surface->node_count += interface[i].point_count - interface[i].outline.point_count;
    surface->triangle_count += interface[i].triangle_count;
  }
  for (int32_t p = CW_ENCLOSING_POINTS; p < region->mesh.point_count; p++)
    surface->inner_count += region->mesh.source[p] >= inner->node_count;
  CW_NEW(surface->x, surface->node_count);
  CW_NEW(surface->shared, surface->node_count);
  CW_NEW(surface->triangle, surface->triangle_count);
  CW_NEW(surface->inner, surface->inner_count);
done:
  return status;
}

CwStatus cw_chew_surface_make(const CwRegionInput *from, int32_t count, const CwChewInterface *interface,
                              CwChewRegion *region, CwChewSurface *surface) {
  CwStatus status = CW_OK;
  const CwRegionBoundary *inner = &region->inner;
  const CwNodeTable *nodes = &from->interfaces->nodes;
  int32_t *local = NULL, *first = NULL, next = inner->node_count, made = 0;
  *surface = (CwChewSurface){0};
  CW_TRY(make_room(count, interface, region, surface));
  int32_t at = surface->fixed_count;
  CW_NEW(local, nodes->count);
  CW_NEW(first, count); // node of the first inserted point
  for (int32_t p = 0; p < inner->node_count; p++) {
    local[inner->node[p]] = p;
    cw_copy(inner->x[p], surface->x[p]);
    surface->shared[p] = nodes->on_plane[inner->node[p]] ? inner->node[p] : -1;
  }
  memcpy(surface->triangle, inner->triangle, (size_t)at * sizeof *surface->triangle);
  for (int32_t i = 0; i < count; i++) {
    int side = interface[i].region[1] == region->region, planned = interface[i].outline.point_count;
    if (interface[i].region[side] != region->region) continue;
    first[i] = next;
    for (int32_t t = 0; t < interface[i].triangle_count; t++) {
      for (int k = 0; k < 3; k++) {
        int32_t p = interface[i].triangle[t][side ? 2 - k : k];
        surface->triangle[at][k] = p < planned ? local[interface[i].outline.node[p]] : next + p - planned;
      }
      at++;
    }
    for (int32_t p = planned; p < interface[i].point_count; p++, next++) {
      cw_copy(interface[i].x[p], surface->x[next]);
      surface->shared[next] = nodes->count + INSERTED_MOST * i + p - planned;
    }
  }
  for (int32_t p = CW_ENCLOSING_POINTS; p < region->mesh.point_count; p++) {
    int32_t *source = &region->mesh.source[p];
    if (*source >= inner->node_count) {
      *source = surface->node_count + made;
      cw_copy(region->mesh.point[p].x, surface->inner[made++]);
    } else if (*source <= CW_CHEW_SPLIT) {
      const CwChewSplit *split = &region->split[CW_CHEW_SPLIT - *source];
      *source = first[split->interface] + split->point - interface[split->interface].outline.point_count;
    }
  }
done:
  free(local);
  free(first);
  if (status != CW_OK) cw_chew_surface_free(surface);
  return status;
}

void cw_chew_surface_free(CwChewSurface *surface) {
  free(surface->x);
  free(surface->triangle);
  free(surface->shared);
  free(surface->inner);
  *surface = (CwChewSurface){0};
}

CwStatus cw_chew_fill(const CwRegionInput *from, const CwChewSurface *surface, const char *name, CwTetMesh *mesh,
                      CwFill *fill) {
  CwStatus status = CW_OK;
  CwKernelOutcome outcome;
  CwFillInput input = {.point_count = surface->node_count,
                       .x = (const double(*)[3])surface->x,
                       .triangle_count = surface->triangle_count,
                       .triangle = (const int32_t(*)[3])surface->triangle,
                       .size = from->in->size_at,
                       .size_context = from->in->size,
                       .name = name,
                       .log = from->log,
                       .inner_count = surface->inner_count,
                       .bare_first = surface->wall_count,
                       .bare_count = surface->fixed_count - surface->wall_count,
                       .inner = (const double(*)[3])surface->inner};
  CW_TRY(cw_kernel_finish(&input, mesh, surface->node_count + surface->inner_count, fill, &outcome));
  if (outcome != CW_KERNEL_FILLED) CW_TRY(cw_fill_with_fallback(&input, CW_FILL_KERNEL, fill));
done:
  return status;
}

CwStatus cw_chew_region_mesh(const char *domain, int32_t region, const CwChewSurface *surface, const CwFill *fill,
                             CwRegionMesh *mesh) {
  CwStatus status = CW_OK;
  const int32_t fixed = surface->fixed_count;
  CwRegionData *cells = &mesh->cells;
  int32_t *place = NULL, next = 0;
  memset(mesh, 0, sizeof *mesh);
  snprintf(mesh->domain, sizeof mesh->domain, "%s", domain);
  mesh->region = mesh->number = region + 1;
  cells->point_count = fill->point_count;
  cells->tetrahedron_count = fill->tetrahedron_count;
  cells->triangle_count = fixed;
  for (int32_t p = 0; p < surface->node_count; p++) cells->shared_count += surface->shared[p] >= 0;
  CW_NEW(place, fill->point_count);
  CW_NEW(cells->points, cells->point_count);
  CW_NEW(cells->shared_id, cells->shared_count);
  CW_NEW(cells->tetrahedra, cells->tetrahedron_count);
  CW_NEW(cells->triangles, fixed);
  CW_NEW(cells->triangle_patch, fixed);
  CW_NEW(cells->triangle_cell, fixed);
  for (int shared = 1; shared >= 0; shared--) { // shared points first
    for (int32_t p = 0; p < fill->point_count; p++) {
      int of_plane = p < surface->node_count && surface->shared[p] >= 0;
      if (of_plane != shared) continue;
      if (shared) cells->shared_id[next] = surface->shared[p];
      cw_copy(fill->x[p], cells->points[next]);
      place[p] = next++;
    }
  }
  for (int32_t t = 0; t < fill->tetrahedron_count; t++) {
    for (int k = 0; k < 4; k++) cells->tetrahedra[t][k] = place[fill->tetrahedron[t][k]];
  }
  for (int32_t t = 0; t < fixed; t++) {
    for (int k = 0; k < 3; k++) cells->triangles[t][k] = place[surface->triangle[t][k]];
  }
  CW_TRY(cw_tets_on(fill->point_count, fixed, (const int32_t(*)[3])surface->triangle, fill->tetrahedron_count,
                    (const int32_t(*)[4])fill->tetrahedron, cells->triangle_cell));
done:
  free(place);
  if (status != CW_OK) cw_region_free(mesh);
  return status;
}
