// SPDX-License-Identifier: AGPL-3.0-or-later
// Is a point inside a closed triangulated surface? By the parity of the triangles above it.
#ifndef CUTWATER_MESHER_CAD_INSIDE_H
#define CUTWATER_MESHER_CAD_INSIDE_H

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwInside CwInside;

// Keeps the given arrays, which must outlive it. The surface may consist of several shells; voids count as
// outside.
CwStatus cw_inside_make(int32_t point_count, const double (*x)[3], int32_t triangle_count, const int32_t (*triangle)[3],
                        CwInside **inside);
void cw_inside_free(CwInside **inside);

// 1 inside, 0 outside; either for points on the surface. A ray through an edge or a corner counts each
// crossing once.
int cw_inside_test(const CwInside *inside, const double p[3]);

#ifdef __cplusplus
}
#endif
#endif
