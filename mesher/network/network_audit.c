// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/network/network_audit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/common/vtk.h"

static const double NEAR = 1e-6; // of the model's unit: more than tracing and corners that are one leave between places

static CwStatus audit_polyline(const CwNetwork *network, int32_t i) {
  CwStatus status = CW_OK;
  const CwCurve *curve = &network->curve[i];
  int32_t last = curve->fine_count - 1;
  CW_REQUIRE(last >= 1 && curve->fine_length[0] == 0, CW_ERR_FAULT, "curve %d has %d points and begins at %g", i,
             curve->fine_count, last >= 0 ? curve->fine_length[0] : 0);
  for (int end = 0; end < 2; end++) {
    int32_t corner = curve->corner[end];
    CW_REQUIRE(corner >= 0 && corner < network->corner_count, CW_ERR_FAULT, "curve %d has the corner %d of %d", i,
               corner, network->corner_count);
    double off = cw_distance(network->corner[corner].x, curve->fine_x[end ? last : 0]);
    CW_REQUIRE(off <= NEAR, CW_ERR_FAULT, "curve %d ends %.3g mm off its corner at (%.3f, %.3f, %.3f) mm", i,
               cw_mm(off), CW_MM(network->corner[corner].x));
  }
  for (int32_t k = 0; k < last; k++) {
    double way = cw_distance(curve->fine_x[k], curve->fine_x[k + 1]),
           rise = curve->fine_length[k + 1] - curve->fine_length[k];
    CW_REQUIRE(way > 0 && fabs(rise - way) <= NEAR * way + 1e-14, CW_ERR_FAULT,
               "curve %d: its length rises by %.17g over a way of %.17g at (%.3f, %.3f, %.3f) mm", i, rise, way,
               CW_MM(curve->fine_x[k]));
  }
done:
  return status;
}

static CwStatus audit_planes(const CwNetwork *network, int32_t i) {
  CwStatus status = CW_OK;
  const CwCurve *curve = &network->curve[i];
  for (int p = 0; p < 2; p++) {
    if (curve->plane[p] < 0) continue;
    const CwPlane *plane = &network->plan->node[curve->plane[p]].plane;
    for (int32_t k = 0; k < curve->fine_count; k++) {
      double off = fabs(cw_plane_distance(plane, curve->fine_x[k]));
      CW_REQUIRE(off <= NEAR, CW_ERR_FAULT, "curve %d lies %.3g mm off plane %d at (%.3f, %.3f, %.3f) mm", i,
                 cw_mm(off), curve->plane[p], CW_MM(curve->fine_x[k]));
    }
  }
done:
  return status;
}

CwStatus cw_network_audit(const CwNetwork *network) {
  CwStatus status = CW_OK;
  uint8_t *on_wall = NULL;
  CW_NEW(on_wall, network->corner_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    CW_TRY(audit_polyline(network, i));
    CW_TRY(audit_planes(network, i));
    for (int end = 0; end < 2; end++) on_wall[network->curve[i].corner[end]] |= network->curve[i].wall != 0;
  }
  for (int32_t i = 0; i < network->corner_count; i++) {
    CW_REQUIRE(on_wall[i] == (network->corner[i].on_wall != 0), CW_ERR_FAULT,
               "corner %d at (%.3f, %.3f, %.3f) mm is %s a wall, and %s wall curve ends there", i,
               CW_MM(network->corner[i].x), network->corner[i].on_wall ? "on" : "off", on_wall[i] ? "a" : "no");
  }
done:
  free(on_wall);
  return status;
}

CwStatus cw_network_vtk(const CwNetwork *network, const char *path) {
  CwStatus status = CW_OK;
  int32_t count = network->curve_count, *start = NULL, *kind = NULL, *wall = NULL;
  double(*x)[3] = NULL;
  CW_NEW(start, count + 1);
  CW_NEW(kind, count);
  CW_NEW(wall, count);
  for (int32_t i = 0; i < count; i++) {
    start[i + 1] = start[i] + network->curve[i].fine_count;
    kind[i] = (int32_t)network->curve[i].kind;
    wall[i] = network->curve[i].wall;
  }
  CW_NEW_UNSET(x, start[count]);
  for (int32_t i = 0; i < count; i++)
    memcpy(x + start[i], network->curve[i].fine_x, (size_t)network->curve[i].fine_count * sizeof *x);
  const CwVtkField field[2] = {{"kind", kind, NULL}, {"wall", wall, NULL}};
  const CwVtkLines lines = {.title = "curves",
                            .x = (const double(*)[3])x,
                            .line_count = count,
                            .start = start,
                            .field_count = 2,
                            .field = field};
  CW_TRY(cw_vtk_write_lines(path, &lines));
done:
  free(start);
  free(kind);
  free(wall);
  free(x);
  return status;
}
