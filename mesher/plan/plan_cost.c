// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_cost.h"

#include <math.h>

#include "mesher/plan/plan_lines.h"

static const double OFF_MOST = 0.1;   // share of a region's work past which a plane is hardly wanted
static const double OFF_LIMIT = 0.14; // and past which it is not
static const double SLICE_OFF_MOST = 0.14,
                    SLICE_OFF_FAR = 100; // past that share of its work a slice costs so much more
static const double SLICE_OFF_COST = 3;  // at most
static const double CUT_LAYERS = 4;      // what a plane through the layers along an edge costs
static const double TOUCH = 4;           // what a cut costs that leaves flat triangles beside an edge

double cw_plan_place_cost(CwPlanPlace place) {
  return cw_plan_sharpness(place.worst) + fmin(0.17 * place.grazed, 3) + 0.007 * place.grazed + CUT_LAYERS * place.cut;
}

double cw_plan_touch_cost(double touch) {
  return TOUCH * touch;
}

double cw_plan_unevenness(double work, double wanted, int32_t regions) {
  double off = fabs(work / wanted - 1);
  return 6 * off + 60 * fmax(0, off - OFF_MOST / sqrt(sqrt(regions))) + 60 * fmax(0, off - OFF_LIMIT);
}

double cw_plan_slice_cost(double work, double wanted) {
  if (work <= wanted) return 0;
  double far = fmax(0, work / wanted - 1 - SLICE_OFF_MOST);
  return CW_PLAN_SLICES * cw_plan_unevenness(work, wanted, 1) + fmin(SLICE_OFF_FAR * far, SLICE_OFF_COST);
}
