// SPDX-License-Identifier: AGPL-3.0-or-later
// Places on curves and Newton steps onto planes.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/vec.h"
#include "mesher/network/network.h"
#include "pipeline/order.h"

enum { NEWTON_STEPS = 20 };
static const double ON_PLANE = 1e-12; // of the model's unit: as near as double precision allows

double cw_face_onto_plane(const CwCad *cad, int32_t face, const CwPlane *plane, double uv[2], double x[3]) {
  double distance = 0;
  for (int step = 0; step < NEWTON_STEPS; step++) {
    double xu[3], xv[3];
    cw_cad_face_point(cad, face, uv, x, xu, xv);
    distance = cw_plane_distance(plane, x);
    if (fabs(distance) < ON_PLANE) break;
    // Shortest step on the surface: along G^-1 g, with G the metric and g the gradient of the distance in (u,v).
    double g[2] = {cw_dot(plane->normal, xu), cw_dot(plane->normal, xv)};
    double e = cw_dot(xu, xu), f = cw_dot(xu, xv), h = cw_dot(xv, xv), det = e * h - f * f;
    if (!(det > 0)) break;
    double a[2] = {(h * g[0] - f * g[1]) / det, (e * g[1] - f * g[0]) / det};
    double slope = g[0] * a[0] + g[1] * a[1];
    if (!(slope > 1e-12)) break;
    for (int k = 0; k < 2; k++) uv[k] -= distance * a[k] / slope;
  }
  return fabs(distance);
}

double cw_face_onto_planes(const CwCad *cad, int32_t face, const CwPlane *a, const CwPlane *b, double uv[2],
                           double x[3]) {
  double left = 0;
  for (int step = 0; step < NEWTON_STEPS; step++) {
    double xu[3], xv[3];
    cw_cad_face_point(cad, face, uv, x, xu, xv);
    double da = cw_plane_distance(a, x), db = cw_plane_distance(b, x);
    left = fmax(fabs(da), fabs(db));
    if (left < ON_PLANE) break;
    double m[2][2] = {{cw_dot(a->normal, xu), cw_dot(a->normal, xv)}, {cw_dot(b->normal, xu), cw_dot(b->normal, xv)}};
    double det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    if (det == 0) break;
    uv[0] -= (da * m[1][1] - db * m[0][1]) / det;
    uv[1] -= (db * m[0][0] - da * m[1][0]) / det;
  }
  return left;
}

void cw_curve_point(const CwNetwork *network, const CwCurve *curve, double length, double x[3], double parameter[2]) {
  int32_t low = cw_interval_of(curve->fine_count, curve->fine_length, length), high = low + 1;
  double span = curve->fine_length[high] - curve->fine_length[low];
  double s = span > 0 ? (length - curve->fine_length[low]) / span : 0;
  s = fmin(fmax(s, 0), 1);
  for (int k = 0; k < 2; k++) {
    parameter[k] = curve->fine_parameter[low][k] + s * (curve->fine_parameter[high][k] - curve->fine_parameter[low][k]);
  }
  switch (curve->kind) {
  case CW_CURVE_EDGE:
    cw_cad_edge_point(network->cad, curve->edge, parameter[0], x, NULL);
    break;
  case CW_CURVE_CUT:
    cw_face_onto_plane(network->cad, curve->face[0], &network->plan->node[curve->plane[0]].plane, parameter, x);
    break;
  case CW_CURVE_LINE:
    cw_lerp(curve->fine_x[low], curve->fine_x[high], s, x);
    break;
  }
}

void cw_curve_uv(const CwCad *cad, const CwCurve *curve, const double parameter[2], int32_t face, double uv[2]) {
  if (curve->kind == CW_CURVE_EDGE) {
    cw_cad_edge_uv(cad, curve->edge, face, parameter[0], uv);
  } else {
    memcpy(uv, parameter, sizeof(double[2]));
  }
}

double cw_curve_end_gap(const CwNetwork *network, const CwCurve *curve, int end) {
  const CwCorner *corner = &network->corner[curve->corner[end]];
  if (curve->kind == CW_CURVE_CUT)
    return corner->edge >= 0 ? cw_cad_edge_gap(network->cad, corner->edge, curve->face[0]) : 0;
  if (curve->kind != CW_CURVE_EDGE || corner->vertex < 0) return 0;
  double range[2], t = curve->fine_parameter[end ? curve->fine_count - 1 : 0][0];
  cw_cad_edge_range(network->cad, curve->edge, range);
  return cw_cad_edge_end_gap(network->cad, curve->edge, t > (range[0] + range[1]) / 2);
}

double cw_curve_nearest(const CwCurve *curve, const double x[3]) {
  double best = INFINITY, length = 0;
  for (int32_t i = 0; i + 1 < curve->fine_count; i++) {
    double s = cw_nearest_share(curve->fine_x[i], curve->fine_x[i + 1], x), p[3];
    cw_lerp(curve->fine_x[i], curve->fine_x[i + 1], s, p);
    double distance = cw_distance(p, x);
    if (distance < best) {
      best = distance;
      length = curve->fine_length[i] + s * (curve->fine_length[i + 1] - curve->fine_length[i]);
    }
  }
  return length;
}

CwStatus cw_network_corner(CwNetwork *network, const CwCorner *corner, double tolerance, int32_t *number) {
  CwStatus status = CW_OK;
  for (*number = 0; *number < network->corner_count; ++*number) {
    const CwCorner *old = &network->corner[*number];
    if (old->face == corner->face && old->edge == corner->edge && old->vertex == corner->vertex &&
        !memcmp(old->plane, corner->plane, sizeof old->plane) && cw_distance(old->x, corner->x) <= tolerance) {
      goto done;
    }
  }
  CW_GROW(network->corner, network->corner_capacity, network->corner_count + 1);
  network->corner[network->corner_count++] = *corner;
done:
  return status;
}

CwStatus cw_curve_fine_make(int32_t count, CwCurve *curve) {
  CwStatus status = CW_OK;
  curve->fine_count = count;
  curve->fine_x = NULL;
  curve->fine_parameter = NULL;
  curve->fine_length = NULL;
  CW_NEW(curve->fine_x, count);
  CW_NEW(curve->fine_parameter, count);
  CW_NEW(curve->fine_length, count);
done:
  if (status != CW_OK) cw_curve_fine_free(curve);
  return status;
}

void cw_curve_fine_free(CwCurve *curve) {
  free(curve->fine_x);
  free(curve->fine_parameter);
  free(curve->fine_length);
  curve->fine_x = NULL;
  curve->fine_parameter = NULL;
  curve->fine_length = NULL;
}

CwStatus cw_network_add_curve(CwNetwork *network, CwCurve *curve) {
  CwStatus status = CW_OK;
  CW_GROW(network->curve, network->curve_capacity, network->curve_count + 1);
  for (int32_t i = 1; i < curve->fine_count; i++) {
    curve->fine_length[i] = curve->fine_length[i - 1] + cw_distance(curve->fine_x[i - 1], curve->fine_x[i]);
  }
  network->curve[network->curve_count++] = *curve;
done:
  if (status != CW_OK) cw_curve_fine_free(curve);
  return status;
}

void cw_network_free(CwNetwork *network) {
  for (int32_t i = 0; i < network->curve_count; i++) cw_curve_fine_free(&network->curve[i]);
  free(network->curve);
  free(network->corner);
  memset(network, 0, sizeof *network);
}

CwStatus cw_curve_nodes_make(int32_t count, CwCurveNodes *nodes) {
  CwStatus status = CW_OK;
  nodes->count = count;
  CW_NEW(nodes->node, count);
  CW_NEW(nodes->parameter, count);
done:
  return status;
}

void cw_curve_nodes_free(int32_t curve_count, CwCurveNodes **nodes) {
  for (int32_t i = 0; *nodes && i < curve_count; i++) {
    free((*nodes)[i].node);
    free((*nodes)[i].parameter);
  }
  free(*nodes);
  *nodes = NULL;
}
