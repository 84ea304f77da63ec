// SPDX-License-Identifier: AGPL-3.0-or-later
// The curve network of a decomposed domain: every curve that the mesh must follow, cut into pieces that meet only at
// corners. Each is discretised once for all surfaces that it bounds: wall curves with the surface mesh, free ones with
// the interfaces.
//
//   edge piece   part of a CAD edge between corners
//   cut piece    where a partition plane meets a CAD face, within the plane's cell
//   line piece   where two partition planes meet inside the domain
//
// A curve is a wall curve when at least one surface along it is a wall: layers start there. The others (open patch with
// open patch, open patch with plane, plane with plane) are free curves: they begin where the layers end.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"
#include "mesher/common/verticals.h"
#include "mesher/parallel/outcome.h"
#include "mesher/plan/plan.h"

typedef enum { CW_CURVE_EDGE, CW_CURVE_CUT, CW_CURVE_LINE } CwCurveKind;

typedef struct {
  double x[3];
  int32_t face;     // CAD face it lies inside of, or -1
  int32_t edge;     // CAD edge it lies on, or -1
  double t;         // its place on that edge
  int32_t vertex;   // CAD vertex, or -1
  int32_t plane[3]; // plan nodes through it, -1: none
  int on_wall;      // a wall curve ends here
} CwCorner;

typedef struct {
  CwCurveKind kind;
  int32_t corner[2]; // equal on a closed curve
  int32_t edge;      // edge piece: CAD edge, else -1
  int32_t face[2];   // edge piece: its two faces; cut piece: face[0]; else -1
  int32_t plane[2];  // cut piece: plane[0]; line piece: ancestor, descendant; else -1
  int wall;          // 1: wall curve, 0: free curve
  // Fine polyline with parameters: t of the edge, (u,v) of the cut, or nothing.
  int32_t fine_count;
  double (*fine_x)[3], (*fine_parameter)[2], *fine_length; // length from the start, m
} CwCurve;

// The mesh nodes along a curve, ends included, with their parameters, as in fine_parameter.
typedef struct {
  int32_t count;
  int32_t *node;
  double (*parameter)[2];
} CwCurveNodes;

typedef struct {
  const CwCad *cad;
  const CwPlan *plan;
  int32_t corner_count, corner_capacity;
  CwCorner *corner;
  int32_t curve_count, curve_capacity;
  CwCurve *curve;
} CwNetwork;

// Builds corners and curves. Collective. Outcome: CW_OUTCOME_REPLAN where a plane touches a face
// or an edge in a way that cannot be resolved.
CwStatus cw_network_make(const CwContext *context, const CwCad *cad, const CwBackground *background,
                         const CwVerticals *inside, const CwPlan *plan, CwNetwork *network, CwOutcome *outcome);
void cw_network_free(CwNetwork *network);

CwStatus cw_curve_nodes_make(int32_t count, CwCurveNodes *nodes);
void cw_curve_nodes_free(int32_t curve_count, CwCurveNodes **nodes); // of an array

// Point of a curve at arc length `length` of its fine polyline, exactly on its surfaces; parameter (2 values) as in
// fine_parameter.
void cw_curve_point(const CwNetwork *network, const CwCurve *curve, double length, double x[3], double parameter[2]);

// (u,v) on `face`, along which an edge piece or a cut piece runs, of its place with this parameter.
void cw_curve_uv(const CwCad *cad, const CwCurve *curve, const double parameter[2], int32_t face, double uv[2]);

// Arc length of the place of the curve nearest to x.
double cw_curve_nearest(const CwCurve *curve, const double x[3]);

// How far an end (0 or 1) of a curve lies beside it, m: more than 0 beside a face that was left out.
double cw_curve_end_gap(const CwNetwork *network, const CwCurve *curve, int end);

// Moves (u,v) on a face along the shortest way onto a plane; returns the distance left, m.
double cw_face_onto_plane(const CwCad *cad, int32_t face, const CwPlane *plane, double uv[2], double x[3]);

// Moves (u,v) on a face onto two planes at once; returns the greater distance left, m.
double cw_face_onto_planes(const CwCad *cad, int32_t face, const CwPlane *a, const CwPlane *b, double uv[2],
                           double x[3]);

// Of the model's unit: corners nearer to one another, on the same things, are one.
static const double cw_same_corner = 1e-8;

// Adds a corner unless one with the same CAD entity and planes lies within `tolerance` m; *number: of that one.
CwStatus cw_network_corner(CwNetwork *network, const CwCorner *corner, double tolerance, int32_t *number);

// Room for a fine polyline of `count` points, whatever stood in the curve before.
CwStatus cw_curve_fine_make(int32_t count, CwCurve *curve);
void cw_curve_fine_free(CwCurve *curve);

// Adds a curve, whose arrays it takes over, and sets its lengths; CW_ERR_MEMORY frees them.
CwStatus cw_network_add_curve(CwNetwork *network, CwCurve *curve);

// Steps of cw_network_make: traces the plane of `node` on every CAD face and adds the pieces within its cell; and the
// same for all planes, which the ranks share.
CwStatus cw_network_trace(CwNetwork *network, const CwBackground *background, int32_t node, CwOutcome *outcome);
CwStatus cw_network_trace_all(const CwContext *context, CwNetwork *network, const CwBackground *background,
                              CwOutcome *outcome);
