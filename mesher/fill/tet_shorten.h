// SPDX-License-Identifier: AGPL-3.0-or-later
// Removal of the longest edges of slender tetrahedra, for the aspect.
#pragma once

#include "mesher/fill/tet_judge.h"

// Goes once over the slender tetrahedra that are wide at their longest edge. Three or four round it are made anew
// without it where the ratio becomes less in the mean; the least quality of those may fall, to the floor.
CwStatus cw_tet_shorten(CwTetWork *w, const CwTetShapes *shapes);
