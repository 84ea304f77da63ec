// SPDX-License-Identifier: AGPL-3.0-or-later
// The wall curves of a domain divided into mesh edges: the first vertices of its surface mesh, and what holds the
// columns of the layers on open edges and partition planes. Every rank needs them all: each face is meshed inside of
// them.
#pragma once

#include "mesher/network/network.h"
#include "mesher/network/periodic_images.h"

// The surface or curve that holds the column of a wall vertex on an open edge or on a partition plane.
typedef enum { CW_CONSTRAINT_NONE, CW_CONSTRAINT_PLANE, CW_CONSTRAINT_PATCH, CW_CONSTRAINT_CURVE } CwConstraintKind;

typedef struct {
  CwConstraintKind kind;
  int32_t index; // plan node, CAD face or curve of the network
} CwConstraint;

typedef struct {
  int32_t vertex_count, x_capacity, constraint_capacity;
  double (*x)[3];
  CwConstraint *constraint; // of each vertex
  CwNodeImages images;      // of the vertices
  int32_t *corner_vertex;   // vertex of each corner of the network, -1: it lies on no wall curve
  int32_t curve_count;
  CwCurveNodes *curve; // along each curve of the network; none along free curves
} CwWallCurves;

// Checks what finished wall curves hold: each wall curve begins and ends at the vertices of its corners, each corner on
// a wall has a vertex of its own, and each other vertex lies inside of one curve alone. CW_ERR_FAULT with the first
// that does not hold.
CwStatus cw_wall_curves_audit(const CwWallCurves *curves, const CwNetwork *network);

// Appends a vertex while wall curves are made.
CwStatus cw_wall_curves_add(CwWallCurves *curves, const double x[3], CwConstraint constraint, int32_t *vertex);

void cw_wall_curves_free(CwWallCurves *curves);
