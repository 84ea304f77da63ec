// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/periodic_boundary.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/plan/plan.h"

static int by_number(const void *p, const void *q) {
  int32_t a = *(const int32_t *)p, b = *(const int32_t *)q;
  return (a > b) - (a < b);
}

CwStatus cw_image_outlines(const CwBoundary *boundary, CwInterfaces *interfaces, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int whole;
  int32_t count = interfaces->outline_count, turns = boundary->images.symmetry->count, *next = NULL, *corner = NULL,
          *start = NULL;
  CW_NEW(start, count + 1);
  for (int32_t i = 0; i < count; i++) start[i + 1] = start[i] + interfaces->outline[i].corner_count;
  CW_NEW(corner, 2 * (size_t)start[count]); // ascending: of each outline, then as one turn takes them
  for (int32_t i = 0; i < count; i++) {
    size_t n = (size_t)interfaces->outline[i].corner_count;
    for (size_t k = 0; k < n; k++) {
      int32_t node = interfaces->outline[i].corner[k];
      corner[start[i] + (int32_t)k] = node;
      corner[start[count] + start[i] + (int32_t)k] = cw_image_node(&interfaces->images, node, 1);
    }
    qsort(corner + start[i], n, sizeof *corner, by_number);
    qsort(corner + start[count] + start[i], n, sizeof *corner, by_number);
  }
  CW_NEW(next, count);
  for (int32_t i = 0; i < count; i++) {
    const CwInterfaceOutline *outline = &interfaces->outline[i];
    int32_t node = cw_sector_turned_node(boundary->plan, turns, 1, outline->node);
    next[i] = -1;
    for (int32_t j = 0; j < count && next[i] < 0; j++) {
      if (interfaces->outline[j].node != node || interfaces->outline[j].corner_count != outline->corner_count) continue;
      size_t size = (size_t)outline->corner_count * sizeof *corner;
      if (!memcmp(corner + start[j], corner + start[count] + start[i], size)) next[i] = j;
    }
    const double *x = interfaces->nodes.x[outline->corner[0]];
    CW_END_UNLESS(next[i] >= 0, outcome, CW_OUTCOME_ASYMMETRIC, x, "an interface on plane %d has no periodic image",
                  outline->node);
  }
  status = cw_images_make(count, next, turns, 1, &interfaces->outline_images, &whole);
  next = NULL;
  CW_TRY(status);
  CW_END_UNLESS(whole, outcome, CW_OUTCOME_ASYMMETRIC, NULL, "turns do not bring the interfaces to themselves");
done:
  free(next);
  free(corner);
  free(start);
  return status;
}

void cw_image_copy_triangles(const CwBoundary *boundary, int32_t (*triangle)[3]) {
  for (int32_t t = 0; t < boundary->surface.triangle_count; t++) {
    int32_t source = boundary->surface.source[t];
    if (source == t) continue;
    int32_t turns = boundary->images.symmetry->face.turns[boundary->surface.face[t]];
    for (int k = 0; k < 3; k++) {
      triangle[t][k] = cw_image_node(&boundary->surface.images, triangle[source][k], turns);
    }
  }
}
