// SPDX-License-Identifier: AGPL-3.0-or-later
// Columns are divided more evenly where checkMesh would else call the determinant of a prism small (thin_prism.h): on
// long edges, and where columns lean. In short columns the outer layers, which give way for the first height, may be as
// thin as a quarter of it; in those that grow the second is the thinnest for its kind, and the first may be a little
// greater than asked.
#pragma once

#include "mesher/parallel/context.h"
#include "mesher/thickness/column_targets.h"

// checkMesh's determinants of the prisms over a wall triangle, from the wall on, whose columns are divided by these
// first heights (m).
void cw_column_determinants(const CwColumnTargets *targets, const CwSurfaceMesh *surface, const CwLayers *layers,
                            int32_t t, const double first[3], double *determinant);

// Sets the first heights of all columns, once they stand: those asked; where layers taper, what leaves them their
// growth; or, around prisms of small determinants that more even layers cure, less in short columns and up to 1.09
// times as much in others, in steps of a twentieth until they do. Periodic images get that of their first. Collective.
CwStatus cw_columns_divide(const CwContext *context, const CwColumnTargets *targets, const CwSurfaceMesh *surface,
                           CwLayers *layers);
