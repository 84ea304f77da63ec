// SPDX-License-Identifier: AGPL-3.0-or-later
// The move of an inner point to where the least quality of its tetrahedra is best.
#pragma once

#include "mesher/fill/tet_work.h"

// Moves the point of t where that gains. *done_it: 1 where it did.
CwStatus cw_tet_move_point(CwTetWork *w, int32_t t, int32_t point, int *done_it);
