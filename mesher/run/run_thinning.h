// SPDX-License-Identifier: AGPL-3.0-or-later
// Thinner layers about the places where a pass has failed, for the next attempt. Each of three attempts on a plan
// reaches twice as far as the one before.
#pragma once

#include "mesher/run/run_state.h"

// A place where the layers have to be thinner, and why.
typedef struct {
  int32_t domain, region; // region -1: on a partition plane, of no region alone
  CwRegionFailure failure;
} CwThinPlace;

typedef struct {
  int32_t count, capacity;
  CwThinPlace *place; // by domain and region
} CwThinPlaces;

void cw_thin_places_free(CwThinPlaces *places);

// Adds those where the layers of the domain of `why` leave no room on its planes; those where regions have failed.
CwStatus cw_thin_places_on_planes(const CwMeshRun *run, const CwOutcome *why, CwThinPlaces *places);
CwStatus cw_thin_places_in_regions(const CwMeshRun *run, CwThinPlaces *places);

// Lowers the columns about these places; attempt: from 0. Outcome: CW_OUTCOME_REPLAN of the domain of the first place
// where there were three.
CwStatus cw_thin(CwMeshRun *run, const CwThinPlaces *places, int attempt, CwOutcome *outcome);

// Forgets what columns were thinned to.
void cw_end_thinning(CwMeshRun *run);
