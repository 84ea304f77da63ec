// SPDX-License-Identifier: AGPL-3.0-or-later
// What the layer envelope is made from: the wall, the asked thicknesses, what holds columns, and what they must not
// reach.
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/mesh/layer_reason.h"

// How columns are divided, for the determinants of prisms.
typedef struct {
  int count; // of layers; 0: determinants are not looked at
  // Share that the last layer takes of the column over a vertex where that is so high (m); NULL: even layers. Any
  // thread.
  double (*last)(const void *context, int32_t vertex, double thickness);
  const void *context;
} CwLayerDivision;

// The fields are six groups: who works, the wall, the asked thickness, where there are no columns, what holds them,
// what they must not reach.
typedef struct {
  const CwContext *context; // the ranks that make the layers
  int32_t point_count;
  const double (*x)[3]; // wall vertices, m
  int32_t triangle_count;
  const int32_t (*triangle)[3]; // wall triangles, normal out of the domain
  const double *target;         // asked thickness of each vertex, normal to the wall, m
  const double *least;          // no column is thinned below this for a better shape of the layer top; NULL: 0
  CwLayerDivision division;
  const uint8_t *pinched; // of each vertex: its column has no height, and the layers around taper; may be NULL: none
  // Sliding constraints: a vertex on an open edge with an open patch, or on a partition plane, marches inside that
  // surface. Up to two per vertex: none: free; one: stays in the tangent plane; two: stays on the line of both. A
  // constrained vertex may have wall on both sides (partition plane) or on one (open edge).
  const int32_t *constraint_count;         // 0, 1, 2 for each vertex; may be NULL: all free
  const double (*constraint_normal)[2][3]; // unit normals of the surfaces that hold the column
  const uint8_t
      *constraint_stays; // of each vertex: held by open patches, which are there in any plan; may be NULL: none
  // Puts a moved vertex back onto its constraints (a cylinder, say); may be NULL. Any thread.
  void (*snap)(const void *context, int32_t vertex, double x[3]);
  const void *snap_context;
  // Surfaces without layers that columns must not reach (open patches: inlet, outlet, rotor/stator interface), normal
  // out of the domain. They may be coarse and need not share points with the wall. Not the partition planes.
  int32_t obstacle_point_count;
  const double (*obstacle_x)[3];
  int32_t obstacle_triangle_count;
  const int32_t (*obstacle_triangle)[3];
} CwLayerInput;

// Whether the column of v has no height.
static inline int cw_layer_pinched(const CwLayerInput *in, int32_t v) {
  return in->pinched && in->pinched[v];
}
// How many constraints hold the column of v, whether one of them is an open patch, and down to which thickness (m) it
// may be thinned for a better shape.
static inline int cw_layer_constraints(const CwLayerInput *in, int32_t v) {
  return in->constraint_count ? in->constraint_count[v] : 0;
}
static inline int cw_layer_stays(const CwLayerInput *in, int32_t v) {
  return in->constraint_stays && in->constraint_stays[v];
}
static inline double cw_layer_least(const CwLayerInput *in, int32_t v) {
  return in->least ? in->least[v] : 0;
}
