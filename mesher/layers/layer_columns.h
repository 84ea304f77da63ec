// SPDX-License-Identifier: AGPL-3.0-or-later
// The columns of a wall while they are made. For the steps of the layer envelope, and for what changes columns once it
// stands (periodic_layers.c and concave_edges.c of the boundary).
#pragma once

#include <stdint.h>

#include "mesher/layers/layer_input.h"

typedef enum { CW_CREASE_NONE, CW_CREASE_CONVEX, CW_CREASE_CONCAVE } CwCrease;

// All normals point into the fluid. A column is t[v] * column[v]: `column` is the displacement for a unit normal
// thickness. The fields are arrays over all vertices, one for each step's result, which later steps read.
typedef struct {
  const CwLayerInput *in;
  int32_t n;                        // vertices
  double (*face_normal)[3];         // unit
  int32_t *face_start, *face;       // triangles around each vertex, ascending
  int32_t *near_start, *near;       // neighbours of each vertex, ascending
  double (*normal)[3], *normal_cos; // most normal direction without constraints; its least cosine to the normals
  double (*base)[3], *base_cos;     // the same inside the constraints
  uint8_t *crease;                  // CwCrease
  double (*along)[3];               // crease: direction of the edge, or zero at a corner
  double (*column)[3];              // unit-thickness displacement
  double *t;                        // thickness, m
  double *most;                     // the target, or less in a concave place: no thickness is greater, m
  int32_t *curve;                   // all vertices along a curve through space: near in the list, near in space
  double *gap;                      // thickness that the gap along a column allows, m; NULL at first
  uint8_t *stale;                   // columns that have changed since then; NULL at first
  struct CwSmoothing *smoothing;    // direction_smoothing.h, whose free it is; NULL before the first
  uint8_t *reason;                  // CwLayerReason
} CwLayerWork;
