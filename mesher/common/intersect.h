// SPDX-License-Identifier: AGPL-3.0-or-later
// Self-intersection of a triangulated surface, exact, through CGAL.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// All pairs of triangles that cross or touch beyond the vertices they share by index. A triangle without area makes a
// pair with itself, two triangles of the same three points make one too. Each pair has its smaller number first; the
// list is sorted, so it is the same each run; the caller frees *pair. x in any unit. Fails with CW_ERR_INPUT on an
// index or a coordinate that is none.
CwStatus cw_self_intersections(int32_t point_count, const double (*x)[3], int32_t triangle_count,
                               const int32_t (*triangle)[3], int32_t *pair_count, int32_t (**pair)[2]);

// Whether triangles a and b cross or touch beyond the vertices they share by index; both must have an area.
int cw_triangles_cross(const double (*x)[3], const int32_t a[3], const int32_t b[3]);

#ifdef __cplusplus
}
#endif
