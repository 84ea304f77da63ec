// SPDX-License-Identifier: AGPL-3.0-or-later
// The stage of the walls: the curves on them, and their triangles.
#pragma once

#include "mesher/run/run_state.h"

// Walls of all domains; repeated with a corrected scale until the prisms and the predicted tetrahedra add up to what
// is asked.
// Outcome: that of cw_domain_start. Collective.
CwStatus cw_run_walls(CwMeshRun *run, CwOutcome *outcome);
