// SPDX-License-Identifier: AGPL-3.0-or-later
// A run that ends after a stage, for a look at what it made.
#pragma once

#include "mesher/run/run_state.h"

// The stage of a name: size, decomposition, curves, surface, layers, interfaces. CW_ERR_USAGE for another.
CwStatus cw_stage_of(const char *name, CwStage *stage);

// Where the run is to end after `stage`: notes that it has, and writes the stage's product of each domain to
// RUN/mesh/DOMAIN-STAGE.vtk where that is asked. Rank 0 writes.
CwStatus cw_stage_view(CwMeshRun *run, CwStage stage);
