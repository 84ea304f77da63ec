// SPDX-License-Identifier: AGPL-3.0-or-later
// What the sources of the smoothing reach.
#ifndef CUTWATER_MESHER_LAYERS_DIRECTION_SMOOTHING_REACH_H
#define CUTWATER_MESHER_LAYERS_DIRECTION_SMOOTHING_REACH_H

#include "mesher/layers/direction_smoothing_work.h"
#include "pipeline/status.h"

// Sets `reach` from the sources. Collective.
CwStatus cw_smoothing_find_reach(CwSmoothing *smoothing);

#endif
