// SPDX-License-Identifier: AGPL-3.0-or-later
// Takes tetrahedra as flat as rounding out of a mesh: a hollow round each is filled from one new point. Where
// boundary points lie in one plane the recovery leaves such, and flips and smoothing cannot always raise them.
#ifndef CUTWATER_MESHER_FILL_KERNEL_FLAT_H
#define CUTWATER_MESHER_FILL_KERNEL_FLAT_H

#include "mesher/fill/delaunay.h"

#ifdef __cplusplus
extern "C" {
#endif

// All tetrahedra of *mesh are inside; their faces on the boundary have no neighbour. New points have sources from
// *source_count on. *raised is how many flat ones are gone, *left how many are not. Deterministic.
CwStatus cw_kernel_flat(CwDelaunay *mesh, int32_t *source_count, int32_t *raised, int32_t *left);

#ifdef __cplusplus
}
#endif
#endif
