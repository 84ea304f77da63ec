// SPDX-License-Identifier: AGPL-3.0-or-later
// How the planner weighs one partition plane against another.
#pragma once

#include "mesher/plan/plan_profile.h"

// What a plane costs by the sharpest wall that it meets and the edges there.
double cw_plan_place_cost(CwPlanPlace place);

// What a plane costs that comes so near to an edge that it runs along (cw_plan_touch).
double cw_plan_touch_cost(double touch);

// What work that is off the wanted one costs in a part that is to become so many regions: the more of them, the less it
// may be off, for the planes that divide it will not be even either.
double cw_plan_unevenness(double work, double wanted, int32_t regions);

// What unevenness weighs where planes across the axis are placed: they have one place to choose where others have
// directions too, and a slice too large is better than a plane along a wall.
#define CW_PLAN_SLICES 0.33

// What a slice across the axis costs that is larger than wanted. One too small keeps nobody waiting: what it lacks the
// others have too much, and they are judged themselves.
double cw_plan_slice_cost(double work, double wanted);
