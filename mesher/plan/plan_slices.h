// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the planes between slices across the axis of a domain stand.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  CW_SLICE_STEPS = 36, // of equal work in an even slice, where planes between slices may stand
  CW_SLICE_MOST = 108  // steps of a slice: half to three times an even one
};

// The places, as steps, of the planes between `slices` slices that cost least together; each plane stands within three
// slices of its even place. slice_cost[n]: of a slice of n steps, up to CW_SLICE_MOST; place_cost[s]: of a plane at
// step s, up to the end. [out] step[slices + 1]: the planes, and both ends. [out] cost: of all. The best way to every
// step from those to the plane before (dynamic programming, Bellman 1957); memory and time grow with the slices.
// CW_ERR_MEMORY.
CwStatus cw_slices_place(int32_t slices, const double *slice_cost, const double *place_cost, int32_t *step,
                         double *cost);

#ifdef __cplusplus
}
#endif
