// SPDX-License-Identifier: AGPL-3.0-or-later
// Local improvement of a part that is divided. The planner takes planes one by one from a grid of directions; here one
// that stands slantwise on walls, or whose lines end slantwise there, or above such a one, is shifted and turned a
// little, to where angles, room, balance and lean together cost less.
#pragma once

#include "mesher/plan/plan_model.h"

// Improves the planes of the subtree of `node` (negative: a region, nothing to do), whose cell is `part`. Nodes and
// regions keep their numbers; notes work and angles in the plan anew.
CwStatus cw_plan_improve(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t node);
