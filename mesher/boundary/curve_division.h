// SPDX-License-Identifier: AGPL-3.0-or-later
// The points that divide the wall curves into mesh edges: so many that on each face the edges lie to one another as
// their curves do (chords.h).
#pragma once

#include "mesher/boundary/boundary.h"
#include "mesher/parallel/context.h"

typedef struct {
  double place; // length along the curve's fine polyline, m
  double x[3], parameter[2];
} CwCurvePoint;

// One curve, ends included. Only the first of each image set is divided.
typedef struct {
  int32_t count;
  int given; // 1: shared with another domain, which has the same points
  CwCurvePoint *point;
} CwCurveDivision;

// The point of a curve at this place.
static inline CwCurvePoint cw_curve_point_at(const CwNetwork *network, const CwCurve *curve, double place) {
  CwCurvePoint point = {place, {0}, {0}};
  cw_curve_point(network, curve, place, point.x, point.parameter);
  return point;
}

// Whether it is a wall curve along this CAD face; -1: no face.
static inline int cw_curve_bounds(const CwCurve *curve, int32_t face) {
  return curve->wall && face >= 0 && (curve->face[0] == face || curve->face[1] == face);
}

// Halves edges of the divisions (of each curve of the network; count 0: none) until on every wall face the edges lie as
// the curves do. Collective.
CwStatus cw_curve_divisions_refine(const CwContext *context, const CwBoundaryInput *in, CwCurveDivision *division);
