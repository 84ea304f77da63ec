// SPDX-License-Identifier: AGPL-3.0-or-later
// A new point in the place of a tetrahedron and of its neighbours that are no better (B. Klingner and J. Shewchuk,
// Aggressive tetrahedral mesh improvement, 2007).
#pragma once

#include "mesher/fill/tet_work.h"

// Of many places round t the one that leaves the best worst tetrahedron, where that gains. *done_it: 1 where it did.
CwStatus cw_tet_insert(CwTetWork *w, int32_t t, int *done_it);
// A new point in the place of t and of all that would be below `aim` with it, from `place` to its best place there.
// Made whether it gains or not, where nothing is below `least` then.
CwStatus cw_tet_insert_at(CwTetWork *w, int32_t t, const double place[3], double aim, double least);
