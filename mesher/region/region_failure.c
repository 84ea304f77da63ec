// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_failure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/intersect.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "pipeline/atomic_file.h"

static const double THINNER = 0.7;

static CwStatus write_boundary(const CwRegionBoundary *boundary, const uint8_t *crossing, const char *name,
                               const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  int32_t count = boundary->wall_count + boundary->cap_count + boundary->interface_count;
  CW_TRY(cw_atomic_file_open(path, &file));
  fprintf(file.stream, "# vtk DataFile Version 3.0\n%s, m\nASCII\nDATASET POLYDATA\nPOINTS %d double\n", name,
          boundary->node_count);
  for (int32_t p = 0; p < boundary->node_count; p++) {
    double x[3];
    for (int k = 0; k < 3; k++) x[k] = cw_model_unit() * boundary->x[p][k];
    fprintf(file.stream, "%.17g %.17g %.17g\n", x[0], x[1], x[2]);
  }
  fprintf(file.stream, "POLYGONS %d %d\n", count, 4 * count);
  for (int32_t t = 0; t < count; t++) {
    const int32_t *corner = boundary->triangle[t];
    fprintf(file.stream, "3 %d %d %d\n", corner[0], corner[1], corner[2]);
  }
  fprintf(file.stream, "CELL_DATA %d\nSCALARS surface int 1\nLOOKUP_TABLE default\n", count);
  for (int32_t t = 0; t < count; t++) {
    fprintf(file.stream, "%d\n", (t >= boundary->wall_count) + (t >= boundary->wall_count + boundary->cap_count));
  }
  fprintf(file.stream, "SCALARS crossing int 1\nLOOKUP_TABLE default\n");
  for (int32_t t = 0; t < count; t++) fprintf(file.stream, "%d\n", crossing[t]);
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}

static void name_patch(const CwSkeleton *skeleton, const CwRegionBoundary *boundary, int32_t triangle, char patch[40]) {
  int32_t source = boundary->source[triangle];
  const char *name = "dividing plane";
  if (triangle < boundary->wall_count) {
    name = cw_cad_patch_name(skeleton->cad, cw_cad_face_patch(skeleton->cad, skeleton->wall_face[source]));
  } else if (triangle < boundary->wall_count + boundary->cap_count) {
    name = cw_cad_patch_name(skeleton->cad, cw_cad_face_patch(skeleton->cad, skeleton->cap_face[source]));
  }
  snprintf(patch, 40, "%s", name);
}

CwStatus cw_region_failure_examine(const CwSkeleton *skeleton, int32_t region, const char *message, const char *path,
                                   CwRegionFailure *failure) {
  CwStatus status = CW_OK;
  CwRegionBoundary boundary = {0};
  int32_t(*pair)[2] = NULL, pairs = 0;
  uint8_t *crossing = NULL;
  char name[64];
  *failure = (CwRegionFailure){.failed = 1, .everywhere = 1};
  snprintf(failure->message, sizeof failure->message, "%s", message);
  snprintf(name, sizeof name, "boundary of region %d", region + 1);
  CW_TRY(cw_region_boundary_make(skeleton, region, 0, &boundary));
  int32_t count = boundary.wall_count + boundary.cap_count + boundary.interface_count;
  CW_NEW(crossing, count);
  CW_TRY(cw_self_intersections(boundary.node_count, (const double(*)[3])boundary.x, count,
                               (const int32_t(*)[3])boundary.triangle, &pairs, &pair));
  for (int32_t p = 0; p < pairs; p++) crossing[pair[p][0]] = crossing[pair[p][1]] = 1;
  if (pairs > 0) {
    const int32_t *corner = boundary.triangle[pair[0][0]];
    failure->everywhere = 0;
    name_patch(skeleton, &boundary, pair[0][0], failure->patch);
    for (int k = 0; k < 9; k++) failure->at[k % 3] += boundary.x[corner[k / 3]][k % 3] / 3;
  }
  CW_TRY(write_boundary(&boundary, crossing, name, path));
done:
  cw_region_boundary_free(&boundary);
  free(crossing);
  free(pair);
  return status;
}

void cw_region_failure_thin(const CwSkeleton *skeleton, int32_t region, const CwRegionFailure *failure, double reach,
                            double *most) {
  double distance = reach * skeleton->size_at(skeleton->size, failure->at);
  for (int32_t t = 0; t < skeleton->wall_triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t v = skeleton->wall_triangle[t][k];
      int near = failure->everywhere ? skeleton->wall_region[t] == region
                                     : cw_distance(skeleton->front[v], failure->at) < distance;
      if (near) most[v] = fmin(most[v], THINNER * skeleton->height[v]);
    }
  }
}
