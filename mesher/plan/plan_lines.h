// SPDX-License-Identifier: AGPL-3.0-or-later
// How the lines in which a new plane meets the planes above it fare: whether they have room outside the layers, keep
// away from CAD edges and from the lines of other planes, and whether the planes meet at a fair angle.
#pragma once

#include "mesher/plan/plan_model.h"

typedef struct {
  double
      cost; // in faults (plan_cost.h): of each line without room, as the square of what it lacks; of the sharpest angle
  double cosine; // least between a line and the normal of a wall where it ends; 1 without lines
} CwPlanLines;

// The lines of `plane`, which is or is to become `node`, with the planes above. They cost INFINITY where one runs
// through the layers of a wall or along that of another plane, or where a parallel plane leaves no room between both:
// then the plane will not do. A line just outside the domain, or in a blade beside its edges, costs as one without
// room: there the planes cut the boundary side by side. May stop at any sum of `most` or more.
CwStatus cw_plan_lines(const CwPlanModel *model, const CwPlan *plan, int32_t node, const CwPlanPart *part,
                       const CwPlane *plane, double most, CwPlanLines *found);
