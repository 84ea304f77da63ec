// SPDX-License-Identifier: AGPL-3.0-or-later
// What a boundary must be before it can be filled, each failure with its place.
#pragma once

#include "mesher/fill/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

// Cheap: coordinates are finite, indices in range, no triangle is without area, every edge has as many triangles
// in one direction as in the other, no two points coincide. Bodies may touch along edges. Fails with CW_ERR_MESH
// and a place in mm.
CwStatus cw_boundary_check(const CwFillInput *input);

// Exact, and slower (about 10 us a triangle): triangles meet only in common edges and corners, and
// none is listed twice.
CwStatus cw_boundary_check_crossing(const CwFillInput *input);

#ifdef __cplusplus
}
#endif
