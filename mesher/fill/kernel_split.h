// SPDX-License-Identifier: AGPL-3.0-or-later
// The surest recovery of a boundary: where flips are stuck, a missing edge or triangle is divided at a place
// where the mesh crosses it. Once what lies outside is gone, these points are taken off the boundary again,
// in the opposite order: each moves a little into the inside, and the triangles it divided become whole, with
// one new tetrahedron each between them and the point (P. L. George, H. Borouchaki, E. Saltel, Int. J. Numer.
// Meth. Eng. 58, 2003). There is always room for that, since every face round the point sees it strictly.
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

// Takes the points off the boundary of a mesh of which only the inside is left. *good is 0 where rounding
// leaves no room for one of them: the mesh is then of no use.
CwStatus cw_kernel_unsplit(CwDelaunay *mesh, const CwSplits *splits, int *good);

void cw_splits_free(CwSplits *splits);

#ifdef __cplusplus
}
#endif
#endif
