// SPDX-License-Identifier: AGPL-3.0-or-later
// The wall vertices over which columns have no height (mesher/layers/pinched.h).
#pragma once

#include "mesher/boundary/boundary.h"

// *pinched: of each vertex, caller frees; NULL where there is none. Periodic images are alike.
CwStatus cw_pinched_vertices(const CwBoundaryInput *in, const CwWallCurves *curves, const CwSurfaceMesh *surface,
                             uint8_t **pinched);
