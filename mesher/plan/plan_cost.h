// SPDX-License-Identifier: AGPL-3.0-or-later
// How the planner weighs one partition plane against another: by faults. What costs 1 has as much wrong with it as may
// be, a sum tells how much is wrong in all.
#pragma once

#include "mesher/plan/plan_profile.h"

// The most that a plane may cost, of those that leave nothing to be wished for.
#define CW_PLAN_FAULT 1

// What an angle between planes or with a wall costs, by its sine: a fault where it is so sharp that two tetrahedra of
// the wanted angle fill it, 0 of a right angle, and as the square between and beyond.
double cw_plan_sharpness(double sine);
int cw_plan_is_sharp(double sine); // whether that is more than a fault

// What a plane costs by the sharpest wall that it meets and the edges there.
double cw_plan_place_cost(CwPlanPlace place);

// What a plane costs that comes so near to an edge (cw_plan_touch): as a sharp angle whose sine is the share of the
// room for triangles that is left. CW_PLAN_UNFIT stays what it is.
double cw_plan_touch_cost(double touch);

// What work that is off the wanted one costs in a part that is to become so many regions: what these cost together if
// they share it evenly. A fault is a region that is off by the most that does not keep ranks waiting (plan_uneven).
double cw_plan_unevenness(double work, double wanted, int32_t regions);

// What a slice across the axis costs that is larger than wanted. One too small keeps nobody waiting: what it lacks the
// others have too much, and they are judged themselves.
double cw_plan_slice_cost(double work, double wanted);
