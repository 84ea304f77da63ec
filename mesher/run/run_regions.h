// SPDX-License-Identifier: AGPL-3.0-or-later
// The stage of the regions: what the regions share, and the mesh of each in its file.
#pragma once

#include "mesher/run/run_thinning.h"

// Regions are made, and the periodic images of each as soon as it is whole. Outcome: CW_OUTCOME_THIN with the places
// where regions could not be made; they have no copies.
// Collective.
CwStatus cw_run_regions(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome);
