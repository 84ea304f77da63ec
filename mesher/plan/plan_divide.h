// SPDX-License-Identifier: AGPL-3.0-or-later
// Divides a part of the domain into regions by the planes that cost least.
#pragma once

#include "mesher/plan/plan_model.h"

// Divides `part` into at most `regions` leaves on side `side` of node `parent` (-1: the whole domain);
// what no plane will do for stays whole. Nodes and regions are appended to the plan, which has room for them.
CwStatus cw_plan_divide(const CwPlanModel *model, CwPlan *plan, const CwPlanPart *part, int32_t regions, int32_t parent,
                        int side);
