// SPDX-License-Identifier: AGPL-3.0-or-later
// The one bridge to TetGen (H. Si, TetGen, a Delaunay-based quality tetrahedral mesh generator, ACM Trans. Math. Softw.
// 41, 2015), which runs in a process of its own: on some boundaries it frees memory twice, or aborts.
#pragma once

#include "mesher/fill/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

// Fills the boundary, which is kept as it is, without points on it. Fails with CW_ERR_MESH naming the region and a
// place (mm) where the boundary is open or crosses itself, or where TetGen cannot fill it. Deterministic. Caller frees
// *fill.
CwStatus cw_tetgen_fill(const CwFillInput *input, CwFill *fill);

#ifdef __cplusplus
}
#endif
