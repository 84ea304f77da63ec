// SPDX-License-Identifier: AGPL-3.0-or-later
// What a fill must hold at its boundary: that each of its triangles is a face, and which of the tetrahedra lie inside.
#pragma once

#include "mesher/fill/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

// Keeps the tetrahedra inside the boundary, by its orientation (so shells may lie in voids of others), and
// drops the inner points that are not used by them; order is kept. Fails with CW_ERR_MESH where a triangle is no
// face.
CwStatus cw_fill_keep_inside(const CwFillInput *input, CwFill *fill);

// Neighbours of tetrahedra: neighbour[t][i] = 4 * other + its face at the face opposite corner i of t, -1
// where there is none. CW_ERR_FAULT where a face has more than two.
CwStatus cw_tet_neighbours(int32_t tetrahedron_count, const int32_t (*tetrahedron)[4], int32_t (*neighbour)[4]);

#ifdef __cplusplus
}
#endif
