// SPDX-License-Identifier: AGPL-3.0-or-later
// The planner (paper, section 2.1): recursive bisection of a domain by planes, on its background triangulation.
// Balances predicted cells, keeps interfaces small, keeps plane-to-wall angles away from sharp, keeps planes away from
// edges of the model and from one another's crossings with them.
#pragma once

#include "mesher/parallel/context.h"
#include "mesher/plan/plan_model.h"

// Collective: the ranks look along some of the directions each, and have the same plan. Caller frees it.
CwStatus cw_plan_make(const CwContext *context, const CwCad *cad, const CwBackground *background,
                      const CwVerticals *inside, const CwSize *size, const CwPlanOptions *options, CwPlan *plan);
