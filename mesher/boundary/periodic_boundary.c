// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/periodic_boundary.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/plan/plan.h"

static int by_number(const void *p, const void *q) {
  int32_t a = *(const int32_t *)p, b = *(const int32_t *)q;
  return (a > b) - (a < b);
}

CwStatus cw_image_copy_curve(CwBoundary *boundary, int32_t first, const int32_t *corner_node, double (*const *x)[3],
                             CwAddCurveNode add) {
  CwStatus status = CW_OK;
  CwNetwork *network = &boundary->network;
  CwPeriodicImages *images = &boundary->images;
  const CwCurve *curve = &network->curve[first];
  int32_t copies = cw_image_copies(images, &images->curve, first), previous = first;
  for (int32_t turns = 1; turns <= copies && copies > 1; turns++) {
    int32_t index = images->curve.next[previous];
    CwCurve *copy = &network->curve[index];
    if (turns < copies) {
      copy->point_count = curve->point_count;
      CW_NEW(copy->node, curve->point_count);
      CW_NEW(copy->parameter, curve->point_count);
      memcpy(copy->parameter, curve->parameter, (size_t)curve->point_count * sizeof *copy->parameter);
    }
    for (int32_t k = 0; k < curve->point_count; k++) {
      if (k == 0 || k == curve->point_count - 1) {
        copy->node[k] = corner_node[copy->corner[k > 0]];
        continue;
      }
      if (turns < copies) {
        double turned[3];
        cw_image_point(images, turns, (*x)[curve->node[k]], turned);
        CW_TRY(add(boundary, copy, turned, &copy->node[k]));
      }
      CW_TRY(cw_image_link(images, network->curve[previous].node[k], copy->node[k], turns % copies));
    }
    previous = index;
  }
done:
  return status;
}

CwStatus cw_image_outlines(CwBoundary *boundary, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int whole;
  CwPeriodicImages *images = &boundary->images;
  int32_t count = boundary->interfaces.outline_count, turns = images->symmetry->count, *next = NULL, *corner = NULL,
          *start = NULL;
  CW_NEW(start, count + 1);
  for (int32_t i = 0; i < count; i++) start[i + 1] = start[i] + boundary->interfaces.outline[i].corner_count;
  CW_NEW(corner, 2 * (size_t)start[count]); // ascending: of each outline, then as one turn takes them
  for (int32_t i = 0; i < count; i++) {
    size_t n = (size_t)boundary->interfaces.outline[i].corner_count;
    for (size_t k = 0; k < n; k++) {
      int32_t node = boundary->interfaces.outline[i].corner[k];
      corner[start[i] + (int32_t)k] = node;
      corner[start[count] + start[i] + (int32_t)k] = cw_image_node(images, node, 1);
    }
    qsort(corner + start[i], n, sizeof *corner, by_number);
    qsort(corner + start[count] + start[i], n, sizeof *corner, by_number);
  }
  CW_NEW(next, count);
  for (int32_t i = 0; i < count; i++) {
    const CwInterfaceOutline *outline = &boundary->interfaces.outline[i];
    int32_t node = cw_sector_turned_node(boundary->plan, turns, 1, outline->node);
    next[i] = -1;
    for (int32_t j = 0; j < count && next[i] < 0; j++) {
      if (boundary->interfaces.outline[j].node != node ||
          boundary->interfaces.outline[j].corner_count != outline->corner_count)
        continue;
      size_t size = (size_t)outline->corner_count * sizeof *corner;
      if (!memcmp(corner + start[j], corner + start[count] + start[i], size)) next[i] = j;
    }
    const double *x = boundary->interfaces.nodes.x[outline->corner[0]];
    CW_END_UNLESS(next[i] >= 0, outcome, CW_OUTCOME_ASYMMETRIC, x, "an interface on plane %d has no periodic image",
                  outline->node);
  }
  status = cw_images_make(count, next, turns, 1, &images->outline, &whole);
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
  const CwPeriodicImages *images = &boundary->images;
  for (int32_t t = 0; t < boundary->surface.triangle_count; t++) {
    int32_t source = boundary->surface.source[t];
    if (source == t) continue;
    int32_t turns = images->symmetry->face.turns[boundary->surface.face[t]];
    for (int k = 0; k < 3; k++) {
      triangle[t][k] = cw_image_node(images, triangle[source][k], turns);
    }
  }
}
