// SPDX-License-Identifier: AGPL-3.0-or-later
// What export reads of the mesh as a whole, and what the record tells of it.
#ifndef CUTWATER_MESHER_RUN_MANIFEST_H
#define CUTWATER_MESHER_RUN_MANIFEST_H

#include "mesher/run/run_state.h"

// Writes RUN/mesh/manifest.json and adds the results to the record. Rank 0 only.
CwStatus cw_mesh_manifest(CwMeshRun *run);

#endif
