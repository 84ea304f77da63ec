// SPDX-License-Identifier: AGPL-3.0-or-later
// Regions whose flattest tetrahedron is below flat_angle and below what the region's boundary would allow.
#ifndef CUTWATER_MESHER_RUN_FLAT_PLACES_H
#define CUTWATER_MESHER_RUN_FLAT_PLACES_H

#include "mesher/run/run_state.h"

// The sum of what these lack, by what they should have; *count: how many there are. Of periodic images the first
// counts.
double cw_flat_deficit(const CwMeshRun *run, int32_t *count);

// Asks for shorter edges at their flattest tetrahedra (run->finer).
CwStatus cw_finer_at_flat(CwMeshRun *run);

#endif
