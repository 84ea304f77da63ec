// SPDX-License-Identifier: AGPL-3.0-or-later
// Steps of the skeleton that know its orbits (orbit.h).
#ifndef CUTWATER_MESHER_ORBIT_SKELETON_H
#define CUTWATER_MESHER_ORBIT_SKELETON_H

#include "mesher/layers.h"
#include "mesher/skeleton.h"

// Finds the orbits of the outlines on all planes. CW_RETRY where they are not symmetric.
CwStatus cw_orbit_outlines(CwSkeleton *skeleton);

// The layers of the whole wall `input` of a skeleton with orbits: grown over the first of each orbit with what stands
// near them, copied, and checked as copied. CW_RETRY where no symmetric front is found.
CwStatus cw_orbit_layers(const CwSkeleton *skeleton, const CwLayerInput *input, CwLayers *layers);

// cw_front_flip on the first wall triangle of each orbit; the copies follow.
CwStatus cw_orbit_front_flip(CwSkeleton *skeleton, const int64_t *group, int32_t *flips);

#endif
