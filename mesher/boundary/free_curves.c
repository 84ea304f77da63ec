// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/free_curves.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"

static CwStatus audit_curve(const CwFreeCurves *free_curves, const CwNetwork *network, int32_t i) {
  CwStatus status = CW_OK;
  const CwCurve *curve = &network->curve[i];
  const CwCurveNodes *nodes = &free_curves->curve[i];
  if (curve->wall) return CW_OK;
  CW_REQUIRE(nodes->count >= 2, CW_ERR_FAULT, "free curve %d has %d nodes", i, nodes->count);
  for (int end = 0; end < 2; end++) {
    int32_t node = nodes->node[end ? nodes->count - 1 : 0], wanted = free_curves->corner_node[curve->corner[end]];
    CW_REQUIRE(node == wanted, CW_ERR_FAULT, "free curve %d ends at node %d; its corner has node %d", i, node, wanted);
  }
  for (int32_t k = 0; k + 1 < nodes->count; k++) {
    int32_t a = nodes->node[k], b = nodes->node[k + 1];
    CW_REQUIRE(a >= 0 && b >= 0 && a < free_curves->nodes.count && b < free_curves->nodes.count && a != b, CW_ERR_FAULT,
               "free curve %d has an edge from node %d to %d of %d", i, a, b, free_curves->nodes.count);
  }
done:
  return status;
}

static CwStatus audit_outline(const CwFreeCurves *free_curves, int32_t i) {
  CwStatus status = CW_OK;
  const CwInterfaceOutline *outline = &free_curves->outline[i];
  CW_REQUIRE(outline->loop_start[0] == 0 && outline->loop_start[outline->loop_count] == outline->corner_count,
             CW_ERR_FAULT, "outline %d: its loops hold %d of %d corners", i, outline->loop_start[outline->loop_count],
             outline->corner_count);
  for (int32_t l = 0; l < outline->loop_count; l++) {
    int32_t corners = outline->loop_start[l + 1] - outline->loop_start[l];
    CW_REQUIRE(corners >= 3, CW_ERR_FAULT, "outline %d: loop %d has %d corners", i, l, corners);
  }
  for (int32_t k = 0; k < outline->corner_count; k++) {
    int32_t node = outline->corner[k];
    CW_REQUIRE(node >= 0 && node < free_curves->nodes.count && free_curves->nodes.on_plane[node], CW_ERR_FAULT,
               "outline %d has the corner %d, which is no node on a plane", i, node);
  }
done:
  return status;
}

CwStatus cw_free_curves_audit(const CwFreeCurves *free_curves, const CwNetwork *network) {
  CwStatus status = CW_OK;
  for (int32_t i = 0; i < network->curve_count; i++) CW_TRY(audit_curve(free_curves, network, i));
  for (int32_t i = 0; i < free_curves->outline_count; i++) CW_TRY(audit_outline(free_curves, i));
done:
  return status;
}

CwStatus cw_node_table_add(CwNodeTable *nodes, const double x[3], int on_plane, int32_t *node) {
  CwStatus status = CW_OK;
  CW_GROW(nodes->x, nodes->x_capacity, nodes->count + 1);
  CW_GROW(nodes->on_plane, nodes->plane_capacity, nodes->count + 1);
  cw_copy(x, nodes->x[nodes->count]);
  nodes->on_plane[nodes->count] = (uint8_t)on_plane;
  *node = nodes->count++;
done:
  return status;
}

void cw_node_table_arrays(CwNodeTable *nodes, CwArrayVisit visit, void *given) {
  nodes->x_capacity = nodes->plane_capacity = nodes->count; // who copies them makes room for no more
  CW_SHOW(visit, given, nodes->x, nodes->count);
  CW_SHOW(visit, given, nodes->on_plane, nodes->count);
}

void cw_outlines_arrays(int32_t count, CwInterfaceOutline **outline, CwImages *images, CwArrayVisit visit,
                        void *given) {
  CW_SHOW(visit, given, images->next, count);
  CW_SHOW(visit, given, images->first, count);
  CW_SHOW(visit, given, images->turns, count);
  CW_SHOW_POINTERS(visit, given, *outline, count);
  for (int32_t i = 0; *outline && i < count; i++) {
    CW_SHOW(visit, given, (*outline)[i].loop_start, (*outline)[i].loop_count + 1);
    CW_SHOW(visit, given, (*outline)[i].corner, (*outline)[i].corner_count);
  }
}

void cw_free_curves_arrays(void *product, CwArrayVisit visit, void *given) {
  CwFreeCurves *free_curves = product;
  free_curves->tight_capacity = free_curves->tight_count; // as of the nodes
  free_curves->outline_capacity = free_curves->outline_count;
  cw_node_table_arrays(&free_curves->nodes, visit, given);
  cw_node_images_arrays(&free_curves->images, visit, given);
  CW_SHOW(visit, given, free_curves->corner_node, free_curves->corner_count);
  CW_SHOW_POINTERS(visit, given, free_curves->curve, free_curves->curve_count);
  for (int32_t i = 0; free_curves->curve && i < free_curves->curve_count; i++) {
    CW_SHOW(visit, given, free_curves->curve[i].node, free_curves->curve[i].count);
    CW_SHOW(visit, given, free_curves->curve[i].parameter, free_curves->curve[i].count);
  }
  CW_SHOW(visit, given, free_curves->tight, free_curves->tight_count);
  cw_outlines_arrays(free_curves->outline_count, &free_curves->outline, &free_curves->outline_images, visit, given);
}

void cw_free_curves_free(CwFreeCurves *free_curves) {
  cw_arrays_free(free_curves, cw_free_curves_arrays, &free_curves->memory);
  memset(free_curves, 0, sizeof *free_curves);
}
