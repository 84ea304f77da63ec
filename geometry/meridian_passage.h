// SPDX-License-Identifier: AGPL-3.0-or-later
// The passage between hub and shroud in the meridian, cut by lines square to the flow: each line meets hub and shroud
// at the same angle, as the chord between the points where a circle touches both.
#pragma once

#include "geometry/meridian.h"

typedef struct {
  double hub[2], shroud[2]; // (r, z) of the line's ends, m
  double height;            // of the passage: the line's length, m
  double length;            // along the middles of the lines from the first, m
  double area;              // of the cone that the line sweeps about the axis, without blades, m2
} CwPassageStation;

// `count` stations, at least 2, at equal steps of the shroud's parameter from the eye to its radius `outlet_radius`, m.
void cw_meridian_passage(const CwMeridianCurve *hub, const CwMeridianCurve *shroud, double outlet_radius, int count,
                         CwPassageStation *station);

// The one from the shroud's point at a radius, m, with the length 0.
CwPassageStation cw_meridian_passage_at(const CwMeridianCurve *hub, const CwMeridianCurve *shroud, double radius);

// The largest step back of the area against its trend from the first to the last station, over the largest (where it
// should grow) or least (where it should fall) area before it; 0: monotone.
double cw_passage_reversal(const CwPassageStation *station, int count);
