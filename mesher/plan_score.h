// SPDX-License-Identifier: AGPL-3.0-or-later
// How the planner weighs one dividing plane against another.
#ifndef CUTWATER_MESHER_PLAN_SCORE_H
#define CUTWATER_MESHER_PLAN_SCORE_H

#include "mesher/plan_lines.h"
#include "mesher/plan_model.h"

// What a place costs by the sharpest wall and the edges grazed there (CwPlanProfile), and by its lines: INFINITY where it
// will not do.
double cw_plan_place_cost(double worst, double grazed);
double cw_plan_line_cost(const CwPlanLines *lines);

// The best plane for `node` (its ancestors are in the plan) to divide a part that is to become `regions` regions;
// *first of them on its negative side. *worst_angle: least sqrt(1 - (n.m)^2) over the wall triangles it
// crosses, they or their layers. *first is 0 where no plane will do at all.
CwStatus cw_plan_best_plane(const CwPlanModel *model, const CwPlan *plan, int32_t node, const CwPlanPart *part,
                            int32_t regions, CwPlane *plane, int32_t *first, double *worst_angle);

// Divides `part`, which is freed, into at most `regions` leaves on side `side` of node `parent` (-1: the whole domain);
// what no plane will do for stays whole. Nodes and regions are appended to the plan, which has room for them.
CwStatus cw_plan_divide(const CwPlanModel *model, CwPlan *plan, CwPlanPart *part, int32_t regions, int32_t parent,
                        int side);

#endif
