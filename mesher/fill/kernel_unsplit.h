// SPDX-License-Identifier: AGPL-3.0-or-later
// The points that divided a boundary (kernel_split) leave it again, in the opposite order: each moves a little into
// the inside, and the triangles it divided become whole, with one new tetrahedron each between them and the point
// (P. L. George, H. Borouchaki, E. Saltel, Int. J. Numer. Meth. Eng. 58, 2003). There is always room for that, since
// every face round the point sees it strictly.
#ifndef CUTWATER_MESHER_FILL_KERNEL_UNSPLIT_H
#define CUTWATER_MESHER_FILL_KERNEL_UNSPLIT_H

#include "mesher/fill/kernel_split.h"

#ifdef __cplusplus
extern "C" {
#endif

// Takes the points off the boundary of a mesh of which only the inside is left. *good is 0 where rounding
// leaves no room for one of them: the mesh is then of no use.
CwStatus cw_kernel_unsplit(CwDelaunay *mesh, const CwSplits *splits, int *good);

#ifdef __cplusplus
}
#endif
#endif
