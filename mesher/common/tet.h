// SPDX-License-Identifier: AGPL-3.0-or-later
// Faces and edges of a tetrahedron (0, 1, 2, 3) with (x1 - x0) x (x2 - x0) . (x3 - x0) > 0.
#pragma once

#include <stdint.h>

// Corners of the face opposite corner i, counter-clockwise from outside.
static const int8_t cw_tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
static const int8_t cw_tet_edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
