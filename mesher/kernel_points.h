// SPDX-License-Identifier: AGPL-3.0-or-later
// Inner points for the kernel: the lattice and the distances of fill_points, made faster: the boundary is
// looked at cell by coarse cell, and a whole line of the lattice is cut by it at once.
#ifndef CUTWATER_MESHER_KERNEL_POINTS_H
#define CUTWATER_MESHER_KERNEL_POINTS_H

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

// As cw_fill_points with a clearance of 1; not the same points. Deterministic. Caller frees *x.
CwStatus cw_kernel_points(const CwFillInput *input, int32_t *count, double (**x)[3]);

#ifdef __cplusplus
}
#endif
#endif
