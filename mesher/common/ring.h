// SPDX-License-Identifier: AGPL-3.0-or-later
// The tetrahedra that take the place of a removed edge: two over each triangle of a triangulated ring round it.
#pragma once

#include <stdint.h>

// Writes the tetrahedra over the part i..j of `ring` round the edge a-b to tet[count...] and returns the new count.
// cut[i * stride + j] is the corner between i and j that the triangle on the side i-j has for its apex.
int cw_ring_tets(const int8_t *cut, int stride, const int32_t *ring, int32_t a, int32_t b, int i, int j,
                 int32_t (*tet)[4], int count);
