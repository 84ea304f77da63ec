// SPDX-License-Identifier: AGPL-3.0-or-later
// How the lines in which a new plane meets the planes above it fare: whether they have room outside the layers, keep
// away from CAD edges and from the lines of other planes, and whether the planes meet at a fair angle.
#ifndef CUTWATER_MESHER_PLAN_LINES_H
#define CUTWATER_MESHER_PLAN_LINES_H

#include "mesher/plan_model.h"

typedef struct {
  int impossible;  // a line runs through the layers of a wall, or along that of another plane, or a parallel plane
                   // leaves no room between both: the plane will not do
  double cramped;  // sum over the lines: 0 where a line has room, 1 where it has none
  int blocked;     // lines that have none
  double sharp;    // least sine of the angle between the planes along a line in the domain; 1 without lines
} CwPlanLines;

CwPlanLines cw_plan_lines(const CwPlanModel *model, const CwPlan *plan, int32_t node, const CwPlanPart *part,
                          const CwPlane *plane);

#endif
