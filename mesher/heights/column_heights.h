// SPDX-License-Identifier: AGPL-3.0-or-later
// How tall the columns of the layers over the wall are asked to be, before gaps and repair have their say: the rules
// that make of a patch's first height, growth and thickness those of each wall vertex.
//
//   meeting patches  the finer first height, the lesser thickness and the larger growth hold
//   first height     grows away from there no faster than columns whose layers grow by a tenth can follow
//   fair height      the last layer no taller than its share of the tetrahedron above (layer_count.h)
#ifndef CUTWATER_MESHER_HEIGHTS_COLUMN_HEIGHTS_H
#define CUTWATER_MESHER_HEIGHTS_COLUMN_HEIGHTS_H

#include "mesher/common/incident.h"
#include "mesher/heights/wall_targets.h"
#include "mesher/skeleton/skeleton.h"

#define CW_TALLEST_COLUMN 2.5 // of the wanted length at the wall: about what columns come to, for the planes

// Of each wall vertex.
typedef struct {
  int layer_count;
  double *first_height; // m
  double *first_made;   // the same by which the column is divided, once it stands (even_columns.h), m
  double *growth;       // largest ratio of neighbouring layers
  double *target;       // height, m
  double *least;        // height down to which a column is thinned for its shape: it has that first height, m
} CwColumnHeights;

// Height below which layers of `first` (m) hardly grow any more: columns are asked to be no shorter.
double cw_column_height_least(double first, int layer_count);

// Height of a column over a flat wall where edges are `size` long, m.
double cw_column_height_flat(const CwLayerTarget *layers, int layer_count, double size);

// Sets first heights, growths, targets and least heights of all wall vertices; layers: of each CAD face; around: the
// wall's triangles. Turned copies get those of their first. Collective. Fails with CW_ERR_MESH where a vertex has no
// triangle.
CwStatus cw_column_heights_make(const CwSkeleton *skeleton, const CwIncident *around, const CwLayerTarget *layers,
                                int layer_count, CwColumnHeights *heights);

// Of the volume (counted in cells) that flat walls would give the layers, the share that columns take once their
// heights are graded. Collective.
CwStatus cw_column_heights_share(const CwColumnHeights *heights, const CwSkeleton *skeleton, const CwIncident *around,
                                 const CwLayerTarget *layers, double *share);

void cw_column_heights_free(CwColumnHeights *heights);

#endif
