// SPDX-License-Identifier: AGPL-3.0-or-later
// What is done about the layers of all domains, side by side: the thicknesses they are asked to have, and the layers.
#ifndef CUTWATER_MESHER_RUN_RUN_LAYERS_H
#define CUTWATER_MESHER_RUN_RUN_LAYERS_H

#include "mesher/run/run_state.h"

// All are collective.

// First heights and targets of all wall vertices, and what they take of the volume, once the walls are merged.
CwStatus cw_run_thickness(CwMeshRun *run);

// Layers of those thicknesses and the room of their columns. Outcome: that of cw_boundary_grow for the first domain
// whose layers do not fit its symmetry or plan.
CwStatus cw_run_layers(CwMeshRun *run, CwOutcome *outcome);

#endif
