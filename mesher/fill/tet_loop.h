// SPDX-License-Identifier: AGPL-3.0-or-later
// The improvement loop: goes over the list of tetrahedra below the limit, and makes of each the first single change
// that raises the least quality of what it touches (L. Freitag and C. Ollivier-Gooch, Int. J. Numer. Meth. Eng. 40,
// 1997).
#pragma once

#include "mesher/fill/tet_work.h"

// So many passes at most, while something changes. The first pass adds no points; none are moved unless `move`.
CwStatus cw_tet_improve_list(CwTetWork *w, int passes, int move);
