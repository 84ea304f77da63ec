// SPDX-License-Identifier: AGPL-3.0-or-later
// Tetrahedra that stand on given triangles.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

// on[t] becomes the tetrahedron of which triangle t is a face, -1 where there is none; of two, the later. Triangles
// stand once. CW_ERR_MEMORY.
CwStatus cw_tets_on(int32_t point_count, int32_t triangle_count, const int32_t (*triangle)[3], int32_t tet_count,
                    const int32_t (*tet)[4], int32_t *on);
