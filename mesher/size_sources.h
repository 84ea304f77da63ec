// SPDX-License-Identifier: AGPL-3.0-or-later
// What asks for a size, and where: patch sizes and curvature all over the surface, gaps, narrow faces, short
// edges.
#ifndef CUTWATER_MESHER_SIZE_SOURCES_H
#define CUTWATER_MESHER_SIZE_SOURCES_H

#include "mesher/background.h"
#include "mesher/size_grid.h"
#include "pipeline/case.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  const CwCad *cad;
  const CwBackground *background;
  const CwMeshTable *table;
  const double *patch_size; // relative, by patch
  double base_size;         // m
} CwSizeInput;

// No single feature asks for less than this share of the base size: what is smaller is resolved by its edges
// alone.
static const double cw_size_least_share = 0.15;

// Seeds `grid` all over the surface with min(patch size, curvature, gap). Curvature asks for at least a
// two fifths of the patch size. A gap is seen by a ray along the inward normal that leaves the domain through a
// facing triangle; walls that meet in a crease there are not a gap.
CwStatus cw_size_seed_surface(const CwSizeInput *input, CwSizeGrid *grid);

// Seeds `grid` along those CAD edges that are creases: with the length of a short one, and with the width of
// the face between two that have no vertex in common.
CwStatus cw_size_seed_edges(const CwSizeInput *input, CwSizeGrid *grid);

#ifdef __cplusplus
}
#endif
#endif
