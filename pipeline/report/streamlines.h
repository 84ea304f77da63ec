// SPDX-License-Identifier: AGPL-3.0-or-later
// Evenly spaced streamlines of a flow that is known by pixel. Method: B. Jobard and W. Lefer, "Creating evenly-spaced
// streamlines of arbitrary density", Visualization in Scientific Computing '97, Springer, 1997: each line begins beside
// another, and ends where it comes too near to one.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

// By pixel, row by row: the velocity to the right and downwards, in any unit, and what the pixel shows; 0: no flow.
// A line keeps to pixels of one group.
typedef struct {
  int width, height;
  const float (*velocity)[2];
  const uint16_t *group;
} CwPixelFlow;

// Lines one after the other: line k has the points from end[k - 1] (0 of the first) to end[k] - 1, px, downstream, a
// pixel apart.
typedef struct {
  double (*point)[2];
  int *end;
  int count, point_count, capacity, point_capacity;
} CwStreamlines;

// Lines about `apart` px from one another, the nearest half of that, and twice that long at least. Zeroed `lines` on
// entry; free it with cw_streamlines_free, also after a failure. CW_ERR_MEMORY.
CwStatus cw_streamlines_make(const CwPixelFlow *flow, double apart, CwStreamlines *lines);
void cw_streamlines_free(CwStreamlines *lines);
