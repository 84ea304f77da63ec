// SPDX-License-Identifier: AGPL-3.0-or-later
// What export reads of the mesh as a whole, and what the record tells of it.
#pragma once

#include "mesher/run/run_state.h"

// Writes RUN/mesh/manifest.json, removes what a mesh of other regions has left, and adds the results to the record.
// Rank 0 only.
CwStatus cw_mesh_manifest(CwMeshRun *run);

// Removes from the folder the region files that the manifest does not name, and the boundaries of regions that have
// failed. What cannot be removed stays.
void cw_mesh_remove_others(const json_t *manifest, const char *folder);
