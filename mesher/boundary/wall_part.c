// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/wall_part.h"

#include <stdlib.h>
#include <string.h>

void cw_wall_part_free(CwWallPart *part) {
  free(part->global);
  free(part->local);
  free(part->x);
  free(part->target);
  free(part->least);
  free(part->pinched);
  free(part->constraint_normal);
  free(part->triangle);
  free(part->constraint_count);
  free(part->constraint_stays);
  memset(part, 0, sizeof *part);
}

static void snap(const void *context, int32_t vertex, double x[3]) {
  const CwWallPart *part = context;
  part->whole->snap(part->whole->snap_context, part->global[vertex], x);
}

static double last_layer(const void *context, int32_t vertex, double thickness) {
  const CwWallPart *part = context;
  const CwLayerDivision *division = &part->whole->division;
  return division->last(division->context, part->global[vertex], thickness);
}

CwStatus cw_wall_part_make(const CwLayerInput *whole, const uint8_t *near, CwWallPart *part) {
  CwStatus status = CW_OK;
  int32_t points = 0, triangles = 0;
  *part = (CwWallPart){.whole = whole, .in = *whole};
  CW_NEW(part->global, whole->point_count);
  CW_NEW(part->local, whole->point_count);
  CW_NEW(part->triangle, whole->triangle_count);
  for (int32_t v = 0; v < whole->point_count; v++) part->local[v] = -1;
  for (int32_t t = 0; t < whole->triangle_count; t++) {
    const int32_t *corner = whole->triangle[t];
    if (!near[corner[0]] && !near[corner[1]] && !near[corner[2]]) continue;
    for (int k = 0; k < 3; k++) {
      if (part->local[corner[k]] < 0) {
        part->global[points] = corner[k];
        part->local[corner[k]] = points++;
      }
      part->triangle[triangles][k] = part->local[corner[k]];
    }
    triangles++;
  }
  CW_NEW(part->x, points);
  CW_NEW(part->target, points);
  if (whole->least) CW_NEW(part->least, points);
  if (whole->pinched) CW_NEW(part->pinched, points);
  if (whole->constraint_count) {
    CW_NEW(part->constraint_count, points);
    CW_NEW(part->constraint_normal, points);
  }
  if (whole->constraint_stays) CW_NEW(part->constraint_stays, points);
  for (int32_t i = 0; i < points; i++) {
    int32_t v = part->global[i];
    memcpy(part->x[i], whole->x[v], sizeof *part->x);
    part->target[i] = whole->target[v];
    if (part->least) part->least[i] = whole->least[v];
    if (part->pinched) part->pinched[i] = whole->pinched[v];
    if (part->constraint_stays) part->constraint_stays[i] = whole->constraint_stays[v];
    if (!part->constraint_count || !whole->constraint_count[v]) continue; // most pages stay zero, and take no memory
    part->constraint_count[i] = whole->constraint_count[v];
    memcpy(part->constraint_normal[i], whole->constraint_normal[v], sizeof *part->constraint_normal);
  }
  part->in.point_count = points;
  part->in.x = (const double(*)[3])part->x;
  part->in.triangle_count = triangles;
  part->in.triangle = (const int32_t(*)[3])part->triangle;
  part->in.target = part->target;
  part->in.least = part->least;
  part->in.pinched = part->pinched;
  part->in.constraint_count = part->constraint_count;
  part->in.constraint_normal = (const double(*)[2][3])part->constraint_normal;
  part->in.constraint_stays = part->constraint_stays;
  if (whole->division.last) {
    part->in.division.last = last_layer;
    part->in.division.context = part;
  }
  if (whole->snap) {
    part->in.snap = snap;
    part->in.snap_context = part;
  }
done:
  return status;
}
