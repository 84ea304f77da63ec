// SPDX-License-Identifier: AGPL-3.0-or-later
// What is done about the walls and layers of all domains, side by side: the walls joined with the thicknesses that
// their columns are asked to have, and the layers. The products lie once on each host.
#pragma once

#include "mesher/run/run_step.h"

// All are collective.

// Surface meshes from the results of their faces, first heights and targets of all wall vertices, lowered where layers
// were thinned (run_thinning.h), and what these take of the volume. Outcome: that of cw_surface_mesh_make for the first
// domain that is not done.
CwStatus cw_run_merge_walls(CwMeshRun *run, const CwResults *results, CwOutcome *outcome);

// Layers of those thicknesses and the room of their columns. Outcome: that of cw_boundary_grow for the first domain
// whose layers do not fit its symmetry or plan.
CwStatus cw_run_layers(CwMeshRun *run, CwOutcome *outcome);
