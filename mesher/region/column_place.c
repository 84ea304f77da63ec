// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/column_place.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"

static int compare_places(const void *p, const void *q) {
  const CwOpenEdgePlace *a = p, *b = q;
  if (a->vertex != b->vertex) return a->vertex < b->vertex ? -1 : 1;
  return (a->face > b->face) - (a->face < b->face);
}

static CwOpenEdgeSide side_of(int32_t a, int32_t b, int32_t face) {
  return (CwOpenEdgeSide){a < b ? a : b, a < b ? b : a, face};
}

static int compare_sides(const void *p, const void *q) {
  const CwOpenEdgeSide *a = p, *b = q;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  return (a->high > b->high) - (a->high < b->high);
}

CwStatus cw_open_edge_places_make(const CwRegionInput *from, CwOpenEdgePlaces *places) {
  CwStatus status = CW_OK;
  const CwCad *cad = from->in->cad;
  int32_t capacity = 0, side_capacity = 0;
  memset(places, 0, sizeof *places);
  CW_GROW(places->place, capacity, 1); // qsort() wants an array even of none
  CW_GROW(places->side, side_capacity, 1);
  for (int32_t i = 0; i < 2 * from->in->network->curve_count; i++) { // either face of each curve
    const CwCurve *curve = &from->in->network->curve[i / 2];
    const CwCurveNodes *nodes = &from->wall_curves->curve[i / 2];
    int32_t face = curve->face[i % 2];
    if (curve->kind != CW_CURVE_EDGE || !curve->wall || cw_cad_face_is_wall(cad, face)) continue;
    CW_GROW(places->place, capacity, places->count + nodes->count);
    CW_GROW(places->side, side_capacity, places->side_count + nodes->count);
    for (int32_t k = 0; k < nodes->count; k++) {
      CwOpenEdgePlace *made = &places->place[places->count++];
      *made = (CwOpenEdgePlace){nodes->node[k], face, {0, 0}};
      cw_cad_edge_uv(cad, curve->edge, face, nodes->parameter[k][0], made->uv);
      if (k > 0) places->side[places->side_count++] = side_of(nodes->node[k - 1], nodes->node[k], face);
    }
  }
  qsort(places->place, (size_t)places->count, sizeof *places->place, compare_places);
  qsort(places->side, (size_t)places->side_count, sizeof *places->side, compare_sides);
done:
  return status;
}

void cw_open_edge_places_free(CwOpenEdgePlaces *places) {
  free(places->place);
  free(places->side);
  memset(places, 0, sizeof *places);
}

int32_t cw_open_edge_face(const CwOpenEdgePlaces *places, int32_t a, int32_t b) {
  const CwOpenEdgeSide key = side_of(a, b, -1);
  const CwOpenEdgeSide *found =
      bsearch(&key, places->side, (size_t)places->side_count, sizeof *places->side, compare_sides);
  return found ? found->face : -1;
}

void cw_column_place(const CwRegionInput *from, const CwOpenEdgePlaces *places, int32_t vertex, double share,
                     double x[3]) {
  const CwConstraint constraint = from->surface->constraint[vertex];
  const CwOpenEdgePlace key = {vertex, constraint.index, {0, 0}}, *found = &key;
  cw_lerp(from->surface->x[vertex], from->layers->top[vertex], share, x);
  if (share <= 0 || share >= 1) return;
  if (constraint.kind == CW_CONSTRAINT_PLANE) return; // the line lies in it
  if (constraint.kind == CW_CONSTRAINT_CURVE && from->in->network->curve[constraint.index].kind == CW_CURVE_LINE)
    return;
  if (constraint.kind == CW_CONSTRAINT_PATCH)
    found = bsearch(&key, places->place, (size_t)places->count, sizeof *places->place, compare_places);
  if (found) cw_boundary_hold(from->in, constraint, found->uv, x);
}
