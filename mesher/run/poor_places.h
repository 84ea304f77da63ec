// SPDX-License-Identifier: AGPL-3.0-or-later
// Where a finished mesh falls short of what counts as good: regions whose flattest tetrahedron is below flat_angle and
// below what the region's boundary would allow, and domains where more than missed_share of the wall faces have not the
// first height that the passage has room for.
#pragma once

#include "mesher/run/run_state.h"

// The sum of what is lacking, over what should be there; *count: regions that are flat (of periodic images the first),
// and domains that miss first heights.
double cw_poor_deficit(const CwMeshRun *run, int32_t *count);

// Whether domains of periodic images fall short.
int cw_poor_in_passages(const CwMeshRun *run);

// Asks for shorter edges there (run->finer).
CwStatus cw_finer_at_poor(CwMeshRun *run);
