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

// Whether it is a wall curve along this CAD face, not -1.
static inline int cw_curve_bounds(const CwCurve *curve, int32_t face) {
  return curve->wall && curve->kind != CW_CURVE_LINE && (curve->face[0] == face || curve->face[1] == face);
}

// Halves edges of the divisions (of each curve of the network; count 0: none) until on every wall face the edges lie as
// the curves do. Collective.
CwStatus cw_curve_divisions_refine(const CwContext *context, const CwBoundaryInput *in, CwCurveDivision *division);
