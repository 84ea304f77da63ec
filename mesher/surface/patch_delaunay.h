// SPDX-License-Identifier: AGPL-3.0-or-later
// Flips of the mesh of a patch until the angles opposite to each free edge add to 180 degrees at most (C. L. Lawson,
// "Software for C1 surface interpolation", Mathematical Software III, 1977).
#pragma once

#include "mesher/surface/patch_work.h"

// Flips towards Delaunay: in the metric of the surface (on_chords = 0; for coarse triangles) or by the angles
// of the triangles in space (1). Returns the number of flips.
int64_t cw_patch_delaunay(CwPatchWork *work, int on_chords);
