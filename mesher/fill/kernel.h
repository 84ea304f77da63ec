// SPDX-License-Identifier: AGPL-3.0-or-later
// Fills a closed triangulated boundary with tetrahedra by our own Delaunay kernel: boundary and inner points
// at once, then the few boundary triangles that are missing are recovered, the inside is kept and improved.
#ifndef CUTWATER_MESHER_FILL_KERNEL_H
#define CUTWATER_MESHER_FILL_KERNEL_H

#include "mesher/fill/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

// Promises and errors of cw_fill, and CW_RETRY where flips do not recover a triangle of the
// boundary, or bodies that touch along an edge have it missing: then fill->recovery still tells how far it got.
// Thread-safe if the size field is.
CwStatus cw_kernel_fill(const CwFillInput *input, CwFill *fill);

#ifdef __cplusplus
}
#endif
#endif
