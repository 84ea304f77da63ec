// SPDX-License-Identifier: AGPL-3.0-or-later
// The columns of a wall while they are made: what stands round each, how good its prisms are, and how one is turned.
// For the steps of the layer envelope, and for what changes columns once it stands (periodic_layers.c and
// concave_edges.c of the boundary).
#ifndef CUTWATER_MESHER_LAYERS_LAYER_COLUMNS_H
#define CUTWATER_MESHER_LAYERS_LAYER_COLUMNS_H

#include <stdint.h>

#include "mesher/layers/layers.h"

// All normals point into the fluid. A column is t[v] * column[v]: `column` is the displacement for a unit normal
// thickness.
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
  double *gap, (*gap_column)[3];    // thickness that the gap along a column allows, m, and that column; NULL at first
  struct CwSmoothing *smoothing;    // direction_smoothing.h; NULL before the first smoothing
  uint8_t *reason;                  // CwLayerReason
} CwLayerWork;

// layers_topology.c: neighbourhoods, weights, face normals. `work` is zeroed before; freed with the other. Collective.
CwStatus cw_layers_topology(const CwLayerInput *input, CwLayerWork *work);
void cw_layers_work_free(CwLayerWork *work);

// layers_normal.c: least product of a vector with the unit normals of the faces around v: of a direction its least
// cosine, of a column its normal thickness.
double cw_layers_least_cosine(const CwLayerWork *work, int32_t v, const double direction[3]);
// Outer end of the column of v at thickness t[v], put back on its constraints.
void cw_layers_place(const CwLayerWork *work, int32_t v, double end[3]);

// layers_turn.c
// Quality (prism_quality.h) of the prism over triangle f with column ends `top`.
double cw_layers_prism_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]);
// How good the column of v is: by the worst prism around it, and where all are good by their layer top and shear too;
// no more than `floor` where one is no better, not looking at the others. *first: which of them is looked at first, and
// then the one that was the worst: most other directions fail there too.
double cw_layers_around(const CwLayerWork *work, int32_t v, const double (*top)[3], double floor, int32_t *first);
// How good the column of v is, as cw_layers_around.
typedef double (*CwLayerJudge)(const CwLayerWork *work, int32_t v, const double (*top)[3], double floor,
                               int32_t *first);
// Tries directions of the column of v near the present one; keeps the best.
void cw_layers_turn(CwLayerWork *work, int32_t v, double (*top)[3], CwLayerJudge judge);

#endif
