// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/wall_curves.h"

#include <stdlib.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"

CwStatus cw_wall_curves_add(CwWallCurves *curves, const double x[3], CwConstraint constraint, int32_t *vertex) {
  CwStatus status = CW_OK;
  CW_GROW(curves->x, curves->x_capacity, curves->vertex_count + 1);
  CW_GROW(curves->constraint, curves->constraint_capacity, curves->vertex_count + 1);
  cw_copy(x, curves->x[curves->vertex_count]);
  curves->constraint[curves->vertex_count] = constraint;
  *vertex = curves->vertex_count++;
done:
  return status;
}

CwStatus cw_wall_curves_audit(const CwWallCurves *curves, const CwNetwork *network) {
  CwStatus status = CW_OK;
  uint8_t *used = NULL;
  CW_NEW(used, curves->vertex_count);
  for (int32_t i = 0; i < network->corner_count; i++) {
    int32_t v = curves->corner_vertex[i];
    CW_REQUIRE(!network->corner[i].on_wall == (v < 0) && v < curves->vertex_count && (v < 0 || !used[v]), CW_ERR_FAULT,
               "wall curves: corner %d at (%.3f, %.3f, %.3f) mm has vertex %d of %d", i, CW_MM(network->corner[i].x), v,
               curves->vertex_count);
    if (v >= 0) used[v] = 1;
  }
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *curve = &network->curve[i];
    const CwCurveNodes *nodes = &curves->curve[i];
    CW_REQUIRE(curve->wall ? nodes->count >= 2 : nodes->count == 0, CW_ERR_FAULT,
               "wall curves: curve %d has %d vertices", i, nodes->count);
    for (int32_t k = 0; k < nodes->count; k++) {
      int32_t v = nodes->node[k];
      if (k == 0 || k == nodes->count - 1) {
        CW_REQUIRE(v == curves->corner_vertex[curve->corner[k > 0]], CW_ERR_FAULT,
                   "wall curves: curve %d ends at vertex %d, its corner has %d", i, v,
                   curves->corner_vertex[curve->corner[k > 0]]);
        continue;
      }
      CW_REQUIRE(v >= 0 && v < curves->vertex_count && !used[v], CW_ERR_FAULT,
                 "wall curves: vertex %d of %d on curve %d lies on another one too", v, curves->vertex_count, i);
      used[v] = 1;
    }
  }
  for (int32_t v = 0; v < curves->vertex_count; v++) {
    CW_REQUIRE(used[v], CW_ERR_FAULT, "wall curves: vertex %d at (%.3f, %.3f, %.3f) mm lies on no curve", v,
               CW_MM(curves->x[v]));
  }
done:
  free(used);
  return status;
}

void cw_wall_curves_free(CwWallCurves *curves) {
  free(curves->x);
  free(curves->constraint);
  cw_node_images_free(&curves->images);
  free(curves->corner_vertex);
  cw_curve_nodes_free(curves->curve_count, &curves->curve);
  *curves = (CwWallCurves){0};
}
