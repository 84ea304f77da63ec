// SPDX-License-Identifier: AGPL-3.0-or-later
// The decomposition of a domain with rotational symmetry (plan.h): one plane across the axis cuts off the side where
// fluid lies on the axis (pipe and nose of the nut), planes parallel to it divide that side into slices, and a sector
// decomposition with the symmetry of the domain divides the other. The wedges of one pitch are divided by any planes,
// and those of the other pitches by the same planes, turned.
#pragma once

#include "mesher/parallel/outcome.h"
#include "mesher/plan/plan_model.h"

// Plans a domain that `count` turns bring to itself. Outcome: CW_OUTCOME_ASYMMETRIC where it has no fluid on the axis
// on one side only, or no plane fits.
CwStatus cw_sector_plan_make(const CwContext *context, const CwCad *cad, const CwBackground *background,
                             const CwVerticals *inside, const CwSize *size, const CwPlanOptions *options, int32_t count,
                             CwPlan *plan, CwOutcome *outcome);
