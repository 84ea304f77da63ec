// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_cost.h"

#include <math.h>

#include "mesher/common/vec.h"
#include "mesher/policy.h"

static double square(double x) {
  return x * x;
}

// Sine of the angle of a wedge that two tetrahedra of the wanted angle fill.
static double sharp(void) {
  return sin(2 * cw_policy.wanted_angle * CW_DEGREE);
}

int cw_plan_is_sharp(double sine) {
  return sine < sharp();
}

double cw_plan_sharpness(double sine) {
  return square((1 - sine) / (1 - sharp()));
}

double cw_plan_place_cost(CwPlanPlace place) {
  // No column leans so much that it could stand on that wall and in the plane.
  double unfit = place.worst < cw_policy.column_least_cosine ? CW_PLAN_UNFIT : 0;
  return cw_plan_sharpness(place.worst) + place.cut + unfit;
}

double cw_plan_touch_cost(double touch) {
  return touch > 1 ? touch : cw_plan_sharpness(1 - touch);
}

double cw_plan_unevenness(double work, double wanted, int32_t regions) {
  return regions * square((work / wanted - 1) / cw_policy.plan_uneven);
}

double cw_plan_slice_cost(double work, double wanted) {
  return work > wanted ? cw_plan_unevenness(work, wanted, 1) : 0;
}
