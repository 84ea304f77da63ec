// SPDX-License-Identifier: AGPL-3.0-or-later
// Vertical lines through a closed triangulated surface: where they cross it, and so whether a point lies inside.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwVerticals CwVerticals;

// Keeps the given arrays, which must outlive it. The surface may consist of several shells; voids count as outside.
CwStatus cw_verticals_make(const double (*x)[3], int32_t triangle_count, const int32_t (*triangle)[3],
                           CwVerticals **verticals);
void cw_verticals_free(CwVerticals **verticals);

// Heights z at which the line at (x, y) crosses the surface, in *z (which belongs to the verticals, until the next
// call: one thread at a time), in any order. A crossing at an edge or corner counts once: inside lie the points below
// an odd number of crossings.
CwStatus cw_verticals_cut(CwVerticals *verticals, double x, double y, int32_t *count, const double **z);

// 1 inside, 0 outside; either for points on the surface. Any thread.
int cw_verticals_inside(const CwVerticals *verticals, const double p[3]);

#ifdef __cplusplus
}
#endif
