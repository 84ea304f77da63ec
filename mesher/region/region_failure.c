// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_failure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/intersect.h"
#include "mesher/common/vec.h"
#include "mesher/common/vtk.h"
#include "mesher/policy.h"

static CwStatus write_boundary(const CwRegionBoundary *inner, const int32_t *crossing, const char *name,
                               const char *path) {
  CwStatus status = CW_OK;
  int32_t count = inner->wall_count + inner->open_patch_count + inner->interface_count, *surface = NULL;
  CW_NEW(surface, count);
  for (int32_t t = inner->wall_count; t < count; t++)
    surface[t] = 1 + (t >= inner->wall_count + inner->open_patch_count);
  const CwVtkField field[2] = {{"surface", surface}, {"crossing", crossing}};
  const CwVtkTriangles triangles = {.title = name,
                                    .point_count = inner->node_count,
                                    .x = (const double(*)[3])inner->x,
                                    .triangle_count = count,
                                    .triangle = (const int32_t(*)[3])inner->triangle,
                                    .field_count = 2,
                                    .field = field};
  CW_TRY(cw_vtk_write(path, &triangles));
done:
  free(surface);
  return status;
}

static void name_patch(const CwBoundary *boundary, const CwRegionBoundary *inner, int32_t triangle, char patch[40]) {
  int32_t source = inner->source[triangle];
  const char *name = "partition plane";
  if (triangle < inner->wall_count) {
    name = cw_cad_patch_name(boundary->cad, cw_cad_face_patch(boundary->cad, boundary->surface.face[source]));
  } else if (triangle < inner->wall_count + inner->open_patch_count) {
    name = cw_cad_patch_name(boundary->cad,
                             cw_cad_face_patch(boundary->cad, boundary->interfaces.open_patch.face[source]));
  }
  snprintf(patch, 40, "%s", name);
}

CwStatus cw_region_failure_examine(const CwBoundary *boundary, int32_t region, const char *message, const char *path,
                                   CwRegionFailure *failure) {
  CwStatus status = CW_OK;
  CwRegionBoundary inner = {0};
  int32_t(*pair)[2] = NULL, pairs = 0;
  int32_t *crossing = NULL;
  char name[64];
  *failure = (CwRegionFailure){.failed = 1, .everywhere = 1};
  snprintf(failure->message, sizeof failure->message, "%s", message);
  snprintf(name, sizeof name, "boundary of region %d", region + 1);
  CW_TRY(cw_region_boundary_make(boundary, region, 0, &inner));
  int32_t count = inner.wall_count + inner.open_patch_count + inner.interface_count;
  CW_NEW(crossing, count);
  CW_TRY(cw_self_intersections(inner.node_count, (const double(*)[3])inner.x, count,
                               (const int32_t(*)[3])inner.triangle, &pairs, &pair));
  for (int32_t p = 0; p < pairs; p++) crossing[pair[p][0]] = crossing[pair[p][1]] = 1;
  if (pairs > 0) {
    const int32_t *corner = inner.triangle[pair[0][0]];
    failure->everywhere = 0;
    name_patch(boundary, &inner, pair[0][0], failure->patch);
    for (int k = 0; k < 9; k++) failure->at[k % 3] += inner.x[corner[k / 3]][k % 3] / 3;
  }
  CW_TRY(write_boundary(&inner, crossing, name, path));
done:
  cw_region_boundary_free(&inner);
  free(crossing);
  free(pair);
  return status;
}

void cw_region_failure_thin(const CwBoundary *boundary, int32_t region, const CwRegionFailure *failure, double reach,
                            double *most) {
  double distance = reach * boundary->size_at(boundary->size, failure->at);
  for (int32_t t = 0; t < boundary->surface.triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t v = boundary->layers.triangle[t][k];
      int near = failure->everywhere ? boundary->surface.region[t] == region
                                     : cw_distance(boundary->layers.top[v], failure->at) < distance;
      if (near) most[v] = fmin(most[v], cw_policy.thinner * boundary->layers.thickness[v]);
    }
  }
}
