// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_failure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesher/common/intersect.h"
#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "mesher/region/region_boundary.h"

static void name_patch(const CwRegionInput *from, const CwRegionBoundary *inner, int32_t triangle, char patch[40]) {
  int32_t source = inner->source[triangle];
  const char *name = "partition plane";
  int32_t walls = inner->wall_count + inner->bare_count;
  if (triangle < walls) {
    name = cw_cad_patch_name(from->in->cad, cw_cad_face_patch(from->in->cad, from->surface->face[source]));
  } else if (triangle < walls + inner->open_patch_count) {
    name =
        cw_cad_patch_name(from->in->cad, cw_cad_face_patch(from->in->cad, from->interfaces->open_patch.face[source]));
  }
  snprintf(patch, 40, "%s", name);
}

CwStatus cw_region_failure_examine(const CwRegionInput *from, int32_t region, const CwOutcome *why, const char *path,
                                   CwRegionFailure *failure) {
  CwStatus status = CW_OK;
  CwRegionBoundary inner = {0};
  int32_t(*pair)[2] = NULL, pairs = 0;
  int32_t *crossing = NULL;
  char name[64];
  *failure = (CwRegionFailure){.failed = 1, .everywhere = why->places == 0};
  snprintf(failure->message, sizeof failure->message, "%.*s", (int)sizeof failure->message - 1, why->reason);
  if (why->places > 0) {
    snprintf(failure->patch, sizeof failure->patch, "the layers");
    cw_copy(why->place[0], failure->at);
  }
  snprintf(name, sizeof name, "boundary of region %d", region + 1);
  CW_TRY(cw_region_boundary_make(from, region, 0, &inner));
  int32_t count = inner.wall_count + inner.bare_count + inner.open_patch_count + inner.interface_count;
  CW_NEW(crossing, count);
  CW_TRY(cw_self_intersections(inner.node_count, (const double(*)[3])inner.x, count,
                               (const int32_t(*)[3])inner.triangle, &pairs, &pair));
  for (int32_t p = 0; p < pairs; p++) crossing[pair[p][0]] = crossing[pair[p][1]] = 1;
  if (pairs > 0 && failure->everywhere) {
    const int32_t *corner = inner.triangle[pair[0][0]];
    failure->everywhere = 0;
    name_patch(from, &inner, pair[0][0], failure->patch);
    for (int k = 0; k < 9; k++) failure->at[k % 3] += inner.x[corner[k / 3]][k % 3] / 3;
  }
  CW_TRY(cw_region_boundary_vtk(&inner, crossing, name, path));
done:
  cw_region_boundary_free(&inner);
  free(crossing);
  free(pair);
  return status;
}

void cw_region_failure_thin(const CwRegionInput *from, int32_t region, const CwRegionFailure *failure, double reach,
                            double *most) {
  double distance = reach * from->in->size_at(from->in->size, failure->at);
  for (int32_t t = 0; t < from->surface->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t v = from->layers->triangle[t][k];
      int near = failure->everywhere ? from->surface->region[t] == region
                                     : cw_distance(from->layers->top[v], failure->at) < distance;
      if (near && from->layers->thickness[v] > 0)
        most[v] = fmin(most[v], cw_policy.column_kept * from->layers->thickness[v]);
    }
  }
}
