// SPDX-License-Identifier: AGPL-3.0-or-later
// What a boundary allows the tetrahedra that fill it, whoever fills it and with whatever points inside.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/common/triangle_bound.h"
#include "mesher/fill/fill.h"

// No filling that keeps the triangles of the closed boundary whole has a least dihedral angle above *degrees: the bound
// of the worst triangle (triangle_bound.h), *worst, -1 where it is CW_TET_BOUND_MOST. Edges with more than two
// triangles bound nothing. Normals point outward, as in a fill.
CwStatus cw_tet_bound(const CwFillInput *boundary, double *degrees, int32_t *worst);
