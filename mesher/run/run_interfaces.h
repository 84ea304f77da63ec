// SPDX-License-Identifier: AGPL-3.0-or-later
// The stages of the surfaces that bear no layers: interfaces and open patches, and the rule of region numbers.
#pragma once

#include "mesher/run/run_thinning.h"

// Collective.

// Free curves, open patches and interfaces. Outcome: CW_OUTCOME_THIN where layers leave no room on the planes, with the
// places of all domains; CW_OUTCOME_ASYMMETRIC; that of cw_interfaces_make for the first domain that is not done.
CwStatus cw_run_interfaces(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome);

// The owners of interfaces refine them where new points of theirs come too near (paper, section 2.3). Not where
// passages are copies of one another: there neither neighbour goes before the other, and both drop their candidates.
CwStatus cw_run_region_rule(CwMeshRun *run);
