// SPDX-License-Identifier: AGPL-3.0-or-later
// The surest recovery of a boundary: where flips are stuck, a missing edge or triangle is divided at a place
// where the mesh crosses it (P. L. George, H. Borouchaki, E. Saltel, Int. J. Numer. Meth. Eng. 58, 2003). Once
// what lies outside is gone, kernel_unsplit takes these points off the boundary again.
#ifndef CUTWATER_MESHER_FILL_KERNEL_SPLIT_H
#define CUTWATER_MESHER_FILL_KERNEL_SPLIT_H

#include "mesher/fill/kernel_facets.h"
#include "mesher/fill/kernel_recover.h"

#ifdef __cplusplus
extern "C" {
#endif

// The boundary triangles (ends[k][0], ends[k][1], apex[k]) that were divided at the point.
typedef struct {
  int32_t point;
  int count; // 2: at their common edge; 1: in the middle
  int32_t ends[2][2], apex[2];
} CwSplit;

typedef struct {
  CwSplit *split;
  int32_t count, space;
} CwSplits;

// Brings all missing triangles into the mesh by flips and divisions; the boundary must not cross itself. New
// points have sources from *source_count on. What cannot be recovered (rounding leaves no room for a point)
// stays missing: see cw_facets_locate afterwards. Adds to *recovered. Deterministic.
CwStatus cw_kernel_split(CwDelaunay *mesh, CwFacets *facets, int32_t *source_count, CwSplits *splits,
                         CwRecovered *recovered);

void cw_splits_free(CwSplits *splits);

#ifdef __cplusplus
}
#endif
#endif
