// SPDX-License-Identifier: AGPL-3.0-or-later
// The layer envelope: for every wall vertex a column, so that the one thick prism over each wall triangle is valid, at
// every layer it is divided into by equal fractions, and the layer top (the wall moved to the outer ends of the
// columns) crosses neither itself nor the wall nor an open patch.
//
//   direction  most normal to the faces around (the least cosine is greatest), inside the sliding constraints
//   length     t / max(cosine, 0.3 on concave edges, 0.55 elsewhere): normal thickness t on every face around
//   smoothing  beside concave edges and columns tilted by a constraint the columns lean away, at the same thickness
//   thickness  least of target, 0.6 of where the columns of a concave place meet, 0.35 gap to a wall, less where
//              that leaves no room for a tetrahedron, 0.6 gap to an open patch, 0.3 x distance more than any neighbour
//   repair     poor prisms and those with a poor layer top are turned, then thinned by 0.8, until nothing is inverted,
//              nothing crosses, and no triangle of the layer top is a needle or turned away that was none on the wall
//
// Best where the surface is not much finer than t beside concave edges. Along straight edges the full thickness is kept
// up to t/h = 3 at 60 degrees and 4.8 at 90; around a bevelled blade in a wedge of 45 degrees at t/h = 4 on 60 %.
#ifndef CUTWATER_MESHER_LAYERS_LAYERS_H
#define CUTWATER_MESHER_LAYERS_LAYERS_H

#include <stdint.h>

#include "mesher/parallel/outcome.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  CW_LAYER_FULL,      // thickness as asked
  CW_LAYER_GAP,       // limited by a narrow gap or a concave place
  CW_LAYER_GRADATION, // limited by neighbours
  CW_LAYER_REPAIR     // limited by validity of the prisms or of the layer top
} CwLayerReason;

// How columns are divided, for the determinants of prisms.
typedef struct {
  int count; // of layers; 0: determinants are not looked at
  // Share that the last layer takes of the column over a vertex where that is so high (m); NULL: even layers.
  double (*last)(const void *context, int32_t vertex, double thickness);
  const void *context;
} CwLayerDivision;

typedef struct {
  int32_t point_count;
  const double (*x)[3]; // wall vertices, m
  int32_t triangle_count;
  const int32_t (*triangle)[3]; // wall triangles, normal out of the domain
  const double *target;         // asked thickness of each vertex, normal to the wall, m
  const double *least;          // no column is thinned below this for a better shape of the layer top; NULL: 0
  CwLayerDivision division;
  // Sliding constraints: a vertex on an open edge with an open patch, or on a partition plane, marches inside that
  // surface. Up to two per vertex: none: free; one: stays in the tangent plane; two: stays on the line of both. A
  // constrained vertex may have wall on both sides (partition plane) or on one (open edge).
  const int32_t *constraint_count;         // 0, 1, 2 for each vertex; may be NULL: all free
  const double (*constraint_normal)[2][3]; // unit normals of the surfaces that hold the column
  const uint8_t
      *constraint_stays; // of each vertex: held by an open patch, which is there in any plan; may be NULL: none
  // Puts a moved vertex back onto its constraints (a cylinder, say); may be NULL.
  void (*snap)(const void *context, int32_t vertex, double x[3]);
  const void *snap_context;
  // Surfaces without layers that columns must not reach (open patches: inlet, outlet, rotor/stator interface), normal
  // out of the domain. They may be coarse and need not share points with the wall. Not the partition planes.
  int32_t obstacle_point_count;
  const double (*obstacle_x)[3];
  int32_t obstacle_triangle_count;
  const int32_t (*obstacle_triangle)[3];
} CwLayerInput;

// The product: one column over each wall vertex. What reads it needs the columns about its own regions.
typedef struct {
  int32_t column_count, triangle_count;
  int32_t (*triangle)[3]; // wall triangles that they stand on, normal out of the domain: those of the surface mesh,
                          // some edges flipped between two of one face and region; NULL from cw_layers_make
  double (*top)[3];       // outer end of each column
  double *thickness;      // normal thickness of each column: the least over the faces around, m
  uint8_t *reason;        // CwLayerReason
  int32_t repair_rounds;
  int32_t thinned_count; // columns below 0.99 of the target
} CwLayers;

// Fails with CW_ERR_MESH (place in mm) where no valid envelope is found: the wall crosses itself, an edge leaves no
// direction that sees all faces, or 40 rounds of repair do not do, or a constraint that stays leaves none; with
// CW_ERR_INPUT on wrong input (triangles without area, points without triangles, thicknesses not above 0). Outcome:
// CW_OUTCOME_REPLAN where another constraint leaves none. Every column has a thickness > 0. Equal input gives equal
// bits. Collective.
CwStatus cw_layers_make(const CwLayerInput *input, CwLayers *layers, CwOutcome *outcome);
void cw_layers_free(CwLayers *layers);

// Checks what finished layers hold: corners of triangles within the columns and distinct, thicknesses above 0, and no
// prism between the wall (x: its vertices) and the layer top turned inside out. CW_ERR_MESH with the first that does
// not hold.
CwStatus cw_layers_audit(const CwLayers *layers, const double (*x)[3]);

// Writes the layer top as VTK PolyData, for a look (cell data reason: why the thinnest column of a triangle is thinner
// than asked; region, as given for each triangle).
CwStatus cw_layers_vtk(const CwLayers *layers, const int32_t *region, const char *path);

#ifdef __cplusplus
}
#endif
#endif
