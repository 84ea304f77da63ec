// SPDX-License-Identifier: AGPL-3.0-or-later
// The last resort of recovery: takes away all tetrahedra that cross a missing boundary triangle (and its
// neighbours that are missing with it), and fills what lies on either side of it from one new point.
#ifndef CUTWATER_MESHER_FILL_KERNEL_CLEAR_H
#define CUTWATER_MESHER_FILL_KERNEL_CLEAR_H

#include "mesher/fill/kernel_facets.h"
#include "mesher/fill/kernel_flips.h"

#ifdef __cplusplus
extern "C" {
#endif

// Does the segment a-b meet the triangle (touching counts)? They share no point.
int cw_kernel_meet(const CwDelaunay *mesh, int32_t a, int32_t b, const int32_t triangle[3]);

// *found is 0, and nothing has changed, where the hollow is too large, other boundary triangles lie in it, or
// no point sees all of a side. New points have sources from *source_count on.
CwStatus cw_kernel_clear(CwFlips *flips, const CwFacets *facets, int32_t facet, int32_t *source_count, int *found);

#ifdef __cplusplus
}
#endif
#endif
