// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/periodic_boundary.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/plan/plan.h"
#include "pipeline/order.h"

CwStatus cw_image_outlines(const CwBoundaryInput *in, CwFreeCurves *free_curves, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int whole;
  int32_t count = free_curves->outline_count, turns = in->images->symmetry->count, *next = NULL, *corner = NULL,
          *start = NULL;
  CW_NEW(start, count + 1);
  for (int32_t i = 0; i < count; i++) start[i + 1] = start[i] + free_curves->outline[i].corner_count;
  CW_NEW(corner, 2 * (size_t)start[count]); // ascending: of each outline, then as one turn takes them
  for (int32_t i = 0; i < count; i++) {
    size_t n = (size_t)free_curves->outline[i].corner_count;
    for (size_t k = 0; k < n; k++) {
      int32_t node = free_curves->outline[i].corner[k];
      corner[start[i] + (int32_t)k] = node;
      corner[start[count] + start[i] + (int32_t)k] = cw_image_node(&free_curves->images, node, 1);
    }
    qsort(corner + start[i], n, sizeof *corner, cw_order_int32s);
    qsort(corner + start[count] + start[i], n, sizeof *corner, cw_order_int32s);
  }
  CW_NEW(next, count);
  for (int32_t i = 0; i < count; i++) {
    const CwInterfaceOutline *outline = &free_curves->outline[i];
    int32_t node = cw_sector_turned_node(in->plan, turns, 1, outline->node);
    next[i] = -1;
    for (int32_t j = 0; j < count && next[i] < 0; j++) {
      if (free_curves->outline[j].node != node || free_curves->outline[j].corner_count != outline->corner_count)
        continue;
      size_t size = (size_t)outline->corner_count * sizeof *corner;
      if (!memcmp(corner + start[j], corner + start[count] + start[i], size)) next[i] = j;
    }
    const double *x = free_curves->nodes.x[outline->corner[0]];
    CW_END_UNLESS(next[i] >= 0, outcome, CW_OUTCOME_ASYMMETRIC, x, "an interface on plane %d has no periodic image",
                  outline->node);
  }
  CW_TRY(cw_images_make(count, &next, turns, 1, &free_curves->outline_images, &whole));
  CW_END_UNLESS(whole, outcome, CW_OUTCOME_ASYMMETRIC, NULL, "turns do not bring the interfaces to themselves");
done:
  free(next);
  free(corner);
  free(start);
  return status;
}

void cw_image_copy_triangles(const CwPeriodicImages *images, const CwSurfaceMesh *surface, int32_t (*triangle)[3]) {
  for (int32_t t = 0; t < surface->triangle_count; t++) {
    int32_t source = surface->source[t];
    if (source == t) continue;
    int32_t turns = images->symmetry->face.turns[surface->face[t]];
    for (int k = 0; k < 3; k++) {
      triangle[t][k] = cw_image_node(&surface->images, triangle[source][k], turns);
    }
  }
}
