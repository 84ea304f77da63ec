// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/nose_division.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/nose.h"
#include "mesher/common/vec.h"
#include "mesher/policy.h"

// Edges over a tip are not shorter than those of so many even ones; along a side one becomes so many at most.
enum { MOST_AT_TIP = 12, MOST_ALONG = 3 };
// Tetrahedra that stand on triangles from side to side of a nose are a fifth as high as the edges along it are long, so
// that the angle between two of their faces has the nose's width over that for its tangent (8.6 degrees where edges
// were 33 widths long).
static const double LENGTH_OVER_HEIGHT = 5;

// A curve, and the other wall curves of its faces.
typedef struct {
  const CwNetwork *network;
  const CwCurve *curve;
  int32_t count, *other;
} Beside;

// Edges that take the place of one between two points.
typedef int Edges(const Beside *beside, const CwCurvePoint *from, const CwCurvePoint *to);

static void normal_at(const CwCad *cad, const CwCurve *curve, const double parameter[2], int32_t face, double n[3]) {
  double uv[2];
  cw_curve_uv(cad, curve, parameter, face, uv);
  cw_cad_face_normal(cad, face, uv, n);
}

// Whether on a face of the curve the normals at two of its points lean from one another by more than columns may.
static int normals_lean(const Beside *beside, const CwCurvePoint *from, const CwCurvePoint *to) {
  const CwCad *cad = beside->network->cad;
  const CwCurve *curve = beside->curve;
  for (int side = 0; side < 2 && curve->face[side] >= 0; side++) {
    double n[3], m[3];
    normal_at(cad, curve, from->parameter, curve->face[side], n);
    normal_at(cad, curve, to->parameter, curve->face[side], m);
    if (cw_dot(n, m) < cw_policy.upright_cosine) return 1;
  }
  return 0;
}

static int edges_at_tip(const Beside *beside, const CwCurvePoint *from, const CwCurvePoint *to) {
  const CwCurve *curve = beside->curve;
  double along[3], step[3], length = to->place - from->place;
  int32_t i = 0;
  if (length * MOST_AT_TIP < 2 * curve->fine_length[curve->fine_count - 1]) return 1;
  cw_sub(to->x, from->x, along);
  cw_unit(along);
  while (i < curve->fine_count && curve->fine_length[i] < from->place) i++;
  for (; i + 1 < curve->fine_count && curve->fine_length[i + 1] <= to->place; i++) {
    cw_sub(curve->fine_x[i + 1], curve->fine_x[i], step);
    if (cw_unit(step) > 0 && cw_dot(step, along) < cw_policy.upright_cosine)
      return normals_lean(beside, from, to) ? 2 : 1;
  }
  return 1;
}

// The width of the nose before a point of the curve, which `other` may bound on its other side, if it is less than
// `least`; else that.
static double width_before(const Beside *beside, const CwCurvePoint *point, const CwCurve *other, double least) {
  const CwCurve *curve = beside->curve;
  const CwCad *cad = beside->network->cad;
  double n[3], m[3];
  if (cw_distance(other->fine_x[0], point->x) - other->fine_length[other->fine_count - 1] > least) return least;
  CwCurvePoint opposite = cw_curve_point_at(beside->network, other, cw_curve_nearest(other, point->x));
  double way = cw_distance(opposite.x, point->x);
  for (int side = 0; side < 2 && way < least; side++) {
    if (!cw_curve_bounds(other, curve->face[side])) continue;
    normal_at(cad, curve, point->parameter, curve->face[side], n);
    normal_at(cad, other, opposite.parameter, curve->face[side], m);
    if (cw_nose_between(n, m)) return way;
  }
  return least;
}

static int edges_along(const Beside *beside, const CwCurvePoint *from, const CwCurvePoint *to) {
  const CwCurvePoint middle = cw_curve_point_at(beside->network, beside->curve, 0.5 * (from->place + to->place));
  double enough = cw_distance(from->x, to->x) / LENGTH_OVER_HEIGHT * tan(cw_policy.wanted_angle * CW_DEGREE);
  double width = enough;
  for (int32_t i = 0; i < beside->count; i++)
    width = width_before(beside, &middle, &beside->network->curve[beside->other[i]], width);
  return (int)fmin(ceil(enough / width), MOST_ALONG);
}

static CwStatus divide(const Beside *beside, Edges *edges, int32_t *count, CwCurvePoint **point) {
  CwStatus status = CW_OK;
  CwCurvePoint *made = NULL;
  int32_t last = *count - 1, number = 0;
  CW_NEW(made, last * MOST_ALONG + 1);
  for (int32_t k = 0; k < last; k++) {
    const CwCurvePoint *from = *point + k, *to = from + 1;
    int parts = edges(beside, from, to);
    made[number++] = *from;
    for (int i = 1; i < parts; i++)
      made[number++] =
          cw_curve_point_at(beside->network, beside->curve, from->place + (to->place - from->place) * i / parts);
  }
  made[number++] = (*point)[last];
  free(*point);
  *point = made;
  *count = number;
done:
  return status;
}

CwStatus cw_curve_divide_at_noses(const CwNetwork *network, const CwCurve *curve, int32_t *count,
                                  CwCurvePoint **point) {
  CwStatus status = CW_OK;
  Beside beside = {.network = network, .curve = curve};
  // A curve that ends beside a left-out face turns there for that alone.
  if (cw_curve_end_gap(network, curve, 0) > 0 || cw_curve_end_gap(network, curve, 1) > 0) goto done;
  CW_NEW_UNSET(beside.other, network->curve_count);
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *other = &network->curve[i];
    if (other != curve && (cw_curve_bounds(other, curve->face[0]) || cw_curve_bounds(other, curve->face[1])))
      beside.other[beside.count++] = i;
  }
  CW_TRY(divide(&beside, edges_along, count, point));
  for (int32_t before = 0; *count > before;) {
    before = *count;
    CW_TRY(divide(&beside, edges_at_tip, count, point));
  }
done:
  free(beside.other);
  return status;
}
