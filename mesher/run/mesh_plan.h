// SPDX-License-Identifier: AGPL-3.0-or-later
// What is done once before the passes: geometry, size fields, regions.
#pragma once

#include "mesher/run/run_state.h"

// All are collective.

// Opens all domains: geometry, background, symmetry, size field and its first scale.
CwStatus cw_mesh_open(CwMeshRun *run);

// Columns have no height any more at those places of `run`, from `first` on, that are pinched.
CwStatus cw_mesh_pinch(CwMeshRun *run, int32_t first);

// Makes the size fields anew, finer at the places of `run`; what followed from the old ones is gone.
CwStatus cw_mesh_resize(CwMeshRun *run);

// Regions for each domain by its share of the predicted cells, at the present scale and factors.
CwStatus cw_mesh_plan(CwMeshRun *run);
// Warns of domains that have fewer regions than the case asks for.
void cw_warn_of_few_cells(const CwMeshRun *run);

// Gives up the symmetries of the domains with a 1 in `whole`: they are planned anew, to be meshed whole. reason: for
// the log.
CwStatus cw_mesh_plan_whole(CwMeshRun *run, const int32_t *whole, const char *reason);

// Another plan for the domain of an outcome. A domain with a symmetry gives it up. Any other, whose plan does not fit
// (a plane grazes a wall, or leaves no room to layers), gets one region more, so that all planes lie elsewhere;
// after three such plans, where it is small enough to be one region, it is not divided at all; else, or where that was
// so, CW_ERR_MESH with the reason.
CwStatus cw_mesh_plan_again(CwMeshRun *run, const CwOutcome *why);
// Whether that would be a divided one with the symmetry that the domain has.
int cw_mesh_has_other_plan(const CwMeshRun *run, int d);
