// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/pinched_vertices.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"

static const double AT_END = 1e-9; // of the length of an edge, by its parameter

// Whether no column can stand at parameter t of an edge: at its ends by all faces about the corner.
static int is_pinched(const CwCad *cad, const CwPinched *pinched, int32_t edge, double t) {
  double range[2];
  int vertex[2];
  cw_cad_edge_range(cad, edge, range);
  cw_cad_edge_vertices(cad, edge, vertex);
  for (int end = 0; end < 2; end++)
    if (fabs(t - range[end]) <= AT_END * (range[1] - range[0])) return pinched->on_corner[vertex[end]];
  return pinched->on_edge[edge] && cw_pinched_at(cad, edge, t);
}

static void mark_on_edges(const CwBoundaryInput *in, const CwWallCurves *curves, uint8_t *mark) {
  for (int32_t c = 0; c < in->network->curve_count; c++) {
    const CwCurve *curve = &in->network->curve[c];
    const CwCurveNodes *nodes = &curves->curve[c];
    if (curve->kind != CW_CURVE_EDGE || !curve->wall) continue;
    for (int32_t k = 0; k < nodes->count; k++)
      mark[nodes->node[k]] |= (uint8_t)is_pinched(in->cad, in->pinched, curve->edge, nodes->parameter[k][0]);
  }
}

static void mark_at_places(const CwPinched *pinched, const CwSurfaceMesh *surface, uint8_t *mark) {
  for (int32_t i = 0; i < pinched->place_count; i++) {
    const CwPinchedPlace *place = &pinched->place[i];
    for (int32_t v = 0; v < surface->vertex_count; v++)
      mark[v] |= cw_distance(surface->x[v], place->x) <= place->radius;
  }
}

static void mark_alike(const CwNodeImages *nodes, int32_t count, uint8_t *mark) {
  for (int32_t v = 0; v < count; v++) {
    uint8_t any = 0;
    if (cw_image_node_turns(nodes, v) > 0) continue;
    for (int32_t at = v; at >= 0; at = cw_image_after(nodes, at, v)) any |= mark[at];
    for (int32_t at = v; at >= 0; at = cw_image_after(nodes, at, v)) mark[at] = any;
  }
}

CwStatus cw_pinched_vertices(const CwBoundaryInput *in, const CwWallCurves *curves, const CwSurfaceMesh *surface,
                             uint8_t **pinched) {
  CwStatus status = CW_OK;
  const CwPinched *of = in->pinched;
  *pinched = NULL;
  if (!of || of->edges + of->corners + of->place_count == 0) goto done;
  CW_NEW(*pinched, surface->vertex_count);
  if (of->edges + of->corners > 0) mark_on_edges(in, curves, *pinched);
  mark_at_places(of, surface, *pinched);
  if (in->images->symmetry) mark_alike(&surface->images, surface->vertex_count, *pinched);
done:
  return status;
}
