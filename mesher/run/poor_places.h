// SPDX-License-Identifier: AGPL-3.0-or-later
// Where a finished mesh falls short of what counts as good: regions whose flattest tetrahedron is below flat_angle and
// below what the region's boundary would allow, and domains where more than missed_share of the wall faces have not the
// first height that the passage has room for.
#pragma once

#include "mesher/run/run_state.h"

// The sum of what is lacking, over what should be there; *count: regions that are flat (of periodic images the first),
// and domains that miss first heights.
double cw_poor_deficit(const CwMeshRun *run, int32_t *count);

// lacks[d]: 1 where domain d falls short, 0 elsewhere.
void cw_poor_domains(const CwMeshRun *run, int32_t lacks[CW_DOMAINS_MOST]);

// Asks for shorter edges there (run->finer); in a flat region also where it is nearly flat, which would come next.
CwStatus cw_finer_at_poor(CwMeshRun *run);
