// SPDX-License-Identifier: AGPL-3.0-or-later
// Which end of a domain about the z axis leads to the impeller: a sector decomposition has its planes across the axis
// there.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/common/verticals.h"

typedef struct {
  double up;              // 1: z grows from that end to the impeller, -1: it falls
  double low, nose, high; // along up * z: ends of the domain; end of the fluid on the axis, or `low` where none is
} CwPlanAxis;

// That end is the one with fluid on the axis, or the narrower one where a shaft goes through. 0 where both ends have
// fluid there: no sector decomposition can be.
int cw_plan_axis_find(const CwBackground *background, const CwVerticals *inside, CwPlanAxis *axis);
