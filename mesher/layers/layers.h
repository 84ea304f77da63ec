// SPDX-License-Identifier: AGPL-3.0-or-later
// The layer envelope: for every wall vertex a column, so that the one thick prism over each wall triangle is valid, at
// every layer it is divided into by equal fractions, and the layer top (the wall moved to the outer ends of the
// columns) crosses neither itself nor the wall nor an open patch.
//
//   direction  most normal to the faces around (the least cosine is greatest; where a knife edge ends, the least share
//              of what each of them allows), inside the sliding constraints
//   length     t / max(cosine, 0.3 on concave edges, 0.55 elsewhere): normal thickness t on every face around
//   smoothing  beside concave edges and columns tilted by a constraint the columns lean away, at the same thickness
//   thickness  least of target, 0.6 of where the columns of a concave place meet, 0.35 gap to a wall, less where
//              that leaves no room for a tetrahedron, 0.6 gap to an open patch, 0.3 x distance more than any neighbour
//   layer top  where two parts of it face each other too near for a tetrahedron, that gap limits the thickness too
//   pinched    no column where none can stand: at these vertices the thickness is 0, and that around rises from there
//   repair     poor prisms and those with a poor layer top are turned, then those columns thinned by 0.8 of which less
//              makes them better, until nothing is inverted, nothing crosses, and no triangle of the layer top is a
//              needle or turned away that was none on the wall
//
// Best where the surface is not much finer than t beside concave edges. Along straight edges the full thickness is kept
// up to t/h = 3 at 60 degrees and 4.8 at 90; around a bevelled blade in a wedge of 45 degrees at t/h = 4 on 60 %.
#pragma once

#include <stdint.h>

#include "mesher/layers/layer_input.h"
#include "mesher/parallel/host_memory.h"
#include "mesher/parallel/outcome.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// The product: one column over each wall vertex. What reads it needs the columns about its own regions.
typedef struct {
  int32_t column_count, triangle_count;
  int32_t (*triangle)[3]; // wall triangles that they stand on, normal out of the domain: those of the surface mesh,
                          // some edges flipped between two of one face and region; NULL from cw_layers_make
  double (*top)[3];       // outer end of each column
  double *thickness;      // normal thickness of each column: the least over the faces around, m; 0: it is pinched
  uint8_t *reason;        // CwLayerReason
  double *first_height;   // of each column, by which it is divided, m; NULL until that is known (even_columns.h)
  int32_t repair_rounds;
  int32_t thinned_count; // columns below 0.99 of the target
  CwHostMemory *memory;  // where its arrays lie; NULL: they are this rank's
} CwLayers;

// How many corners of a triangle have columns of no height.
static inline int cw_layers_pinched(const CwLayers *layers, int32_t triangle) {
  const int32_t *corner = layers->triangle[triangle];
  const double *thickness = layers->thickness;
  return (thickness[corner[0]] == 0) + (thickness[corner[1]] == 0) + (thickness[corner[2]] == 0);
}

// Outcome where no valid envelope is found: CW_OUTCOME_FINER where the wall crosses itself, CW_OUTCOME_PINCH where an
// edge leaves no direction that sees all faces and lies in its open patches, layers cross however thin they are, or the
// rounds of repair do not do; CW_OUTCOME_REPLAN where a partition plane holds the column there. Fails with CW_ERR_INPUT
// on wrong input (triangles without area, points without triangles, thicknesses not above 0). Every column that is not
// pinched has a thickness > 0. Equal input gives equal bits. Collective.
CwStatus cw_layers_make(const CwLayerInput *input, CwLayers *layers, CwOutcome *outcome);
// Shows its arrays (CwArrays).
void cw_layers_arrays(void *layers, CwArrayVisit visit, void *given);
void cw_layers_free(CwLayers *layers);

// Checks what finished layers hold: corners of triangles within the columns and distinct, thicknesses above 0, or
// columns without length, and no prism between the wall (x: its vertices) and the layer top turned inside out.
// CW_ERR_FAULT with the first that does not hold.
CwStatus cw_layers_audit(const CwLayers *layers, const double (*x)[3]);

// Writes the layer top as VTK PolyData, for a look (cell data reason: why the thinnest column of a triangle is thinner
// than asked; region, as given for each triangle).
CwStatus cw_layers_vtk(const CwLayers *layers, const int32_t *region, const char *path);

#ifdef __cplusplus
}
#endif
