// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_directions.h"

#include <math.h>
#include <stdlib.h>

static const double TILT = 0.1; // rad

int32_t cw_direction_turn(int32_t d) {
  return d % CW_TURNS;
}

int32_t cw_direction_tilt(int32_t d) {
  return d / CW_TURNS - CW_TILTS;
}

int32_t cw_direction_at(int32_t turn, int32_t tilt) {
  // Half a turn brings a plane to itself, with its tilt to the other side.
  for (; turn < 0; turn += CW_TURNS) tilt = -tilt;
  for (; turn >= CW_TURNS; turn -= CW_TURNS) tilt = -tilt;
  return abs(tilt) <= CW_TILTS ? (tilt + CW_TILTS) * CW_TURNS + turn : -1;
}

void cw_direction(int32_t d, double normal[3]) {
  // A small odd turn keeps the planes off the symmetry planes of the CAD.
  double angle = M_PI * (cw_direction_turn(d) + 0.37) / CW_TURNS, tilt = TILT * cw_direction_tilt(d);
  normal[0] = d == CW_ALONG_AXIS ? 0 : cos(tilt) * cos(angle);
  normal[1] = d == CW_ALONG_AXIS ? 0 : cos(tilt) * sin(angle);
  normal[2] = d == CW_ALONG_AXIS ? 1 : sin(tilt);
}
