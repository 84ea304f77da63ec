// SPDX-License-Identifier: AGPL-3.0-or-later
// How tall the columns of the layers over the wall are asked to be, before gaps and repair have their say: the rules
// that make of a patch's first height, growth and thickness those of each wall vertex.
//
//   meeting patches  the finer first height, the lesser thickness and the larger growth hold
//   first height     grows away from there no faster than columns whose layers grow by a tenth can follow
//   fair thickness   the last layer no taller than its share of the tetrahedron above (layer_count.h)
#pragma once

#include "mesher/boundary/boundary.h"
#include "mesher/common/incident.h"
#include "mesher/parallel/context.h"
#include "mesher/thickness/wall_targets.h"

// Of each wall vertex.
typedef struct {
  int layer_count;
  int32_t vertex_count;
  double *first_height; // m
  double *growth;       // largest ratio of neighbouring layers
  double *target;       // thickness, m
  double *least;        // thickness down to which a column is thinned for its shape: it has that first height, m
  CwHostMemory *memory; // where its arrays lie; NULL: they are this rank's
} CwColumnTargets;

// Thickness of a column over a flat wall where edges are `size` long, m.
double cw_column_thickness_flat(const CwLayerTarget *layers, int layer_count, double size);

// The same over the point x of a wall with the unit normal `normal`, out of the domain. The tetrahedron on it stands at
// the end of the column, where the size is another than at the wall: the thickness is reckoned twice. Nowhere grow
// sizes faster than thicknesses.
double cw_column_thickness_at(const CwLayerTarget *layers, int layer_count, CwSizeAt size_at, const void *size,
                              const double x[3], const double normal[3]);

// Sets first heights, growths, targets and least thicknesses of all wall vertices; layers: of each CAD face; around:
// the wall's triangles. Periodic images get those of their first. Collective. Fails with CW_ERR_MESH where a vertex has
// no triangle.
CwStatus cw_column_targets_make(const CwContext *context, const CwBoundaryInput *in, const CwSurfaceMesh *surface,
                                const CwIncident *around, const CwLayerTarget *layers, int layer_count,
                                CwColumnTargets *targets);

// Of the volume (counted in cells) that flat walls would give the layers, the share that columns take once their
// thicknesses are graded. Collective.
CwStatus cw_column_targets_share(const CwContext *context, const CwColumnTargets *targets, const CwBoundaryInput *in,
                                 const CwSurfaceMesh *surface, const CwIncident *around, const CwLayerTarget *layers,
                                 double *share);

// Shows its arrays (CwArrays).
void cw_column_targets_arrays(void *targets, CwArrayVisit visit, void *given);
void cw_column_targets_free(CwColumnTargets *targets);
