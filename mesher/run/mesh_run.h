// SPDX-License-Identifier: AGPL-3.0-or-later
// The whole work of the mesher on a case: all domains, in step, over all ranks.
#pragma once

#include "mesher/run/run_state.h"

// Meshes the case: reads RUN/geometry, writes the region files and the manifest into RUN/mesh. Collective over all
// ranks.
CwStatus cw_mesh_run(CwMeshRun *run);
void cw_mesh_run_free(CwMeshRun *run);
