// SPDX-License-Identifier: AGPL-3.0-or-later
// The directions along which the planner looks for planes: a grid of turns about the axis and of tilts, and the axis.
#pragma once

#include <stdint.h>

enum {
  CW_TURNS = 120, // over half a turn, every 1.5 degrees: the other half are the same planes
  CW_TILTS = 13,  // to either side of upright, every 0.1 rad
  CW_ALONG_AXIS = CW_TURNS * (2 * CW_TILTS + 1),
  CW_DIRECTIONS = CW_ALONG_AXIS + 1
};

// The unit normal of planes of direction d. Those of CW_ALONG_AXIS stand across the z axis, upright ones hold its
// direction.
void cw_direction(int32_t d, double normal[3]);

// The direction of so many turns and tilts, of any sign; -1 beyond the last tilt.
int32_t cw_direction_at(int32_t turn, int32_t tilt);
// Turn and tilt of a direction other than CW_ALONG_AXIS.
int32_t cw_direction_turn(int32_t d);
int32_t cw_direction_tilt(int32_t d);

static inline int cw_direction_is_upright(int32_t d) {
  return d != CW_ALONG_AXIS && cw_direction_tilt(d) == 0;
}
