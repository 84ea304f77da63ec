// SPDX-License-Identifier: AGPL-3.0-or-later
// Thinner layers about the places where a pass has failed, for the next attempt. Each of three attempts reaches twice
// as far as the one before; out of attempts the run fails with the first place.
#ifndef CUTWATER_MESHER_RUN_RUN_THINNING_H
#define CUTWATER_MESHER_RUN_RUN_THINNING_H

#include "mesher/run/mesh_run.h"

// Where layers leave no room on the planes; attempt: from 0.
CwStatus cw_thin_tight(CwMeshRun *run, int attempt);

// Where regions have failed.
CwStatus cw_thin_columns(CwMeshRun *run, int attempt);

// Forgets what columns were thinned to.
void cw_end_thinning(CwMeshRun *run);

#endif
