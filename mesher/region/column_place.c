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

CwStatus cw_open_edge_places_make(const CwRegionInput *from, CwOpenEdgePlaces *places) {
  CwStatus status = CW_OK;
  int32_t count = 0;
  memset(places, 0, sizeof *places);
  for (int pass = 0; pass < 2; pass++) {
    if (pass == 1) CW_NEW(places->place, count);
    for (int32_t i = 0; i < from->in->network->curve_count; i++) {
      const CwCurve *curve = &from->in->network->curve[i];
      const CwCurveNodes *nodes = &from->wall_curves->curve[i];
      if (curve->kind != CW_CURVE_EDGE || !curve->wall) continue;
      for (int side = 0; side < 2; side++) {
        int32_t face = curve->face[side];
        if (cw_cad_face_is_wall(from->in->cad, face)) continue;
        count += pass == 0 ? nodes->count : 0;
        for (int32_t k = 0; pass == 1 && k < nodes->count; k++) {
          CwOpenEdgePlace *made = &places->place[places->count++];
          *made = (CwOpenEdgePlace){nodes->node[k], face, {0, 0}};
          cw_cad_edge_uv(from->in->cad, curve->edge, face, nodes->parameter[k][0], made->uv);
        }
      }
    }
  }
  qsort(places->place, (size_t)places->count, sizeof *places->place, compare_places);
done:
  return status;
}

void cw_open_edge_places_free(CwOpenEdgePlaces *places) {
  free(places->place);
  memset(places, 0, sizeof *places);
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
