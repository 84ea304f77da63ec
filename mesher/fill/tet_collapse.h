// SPDX-License-Identifier: AGPL-3.0-or-later
// Points that stand too close go into a neighbour.
#ifndef CUTWATER_MESHER_FILL_TET_COLLAPSE_H
#define CUTWATER_MESHER_FILL_TET_COLLAPSE_H

#include "mesher/fill/tet_judge.h"

#ifdef __cplusplus
extern "C" {
#endif

// Takes away inner points with the shortest edges of many slender tetrahedra: a point goes into the other end of its
// shortest one where the aspects, less the usual one, become less in the sum, or by so little more that relaxing makes
// up for it. The least quality of its tetrahedra may fall, to the floor. All are to be judged anew then.
CwStatus cw_tet_collapse(CwTetWork *w, const CwTetShapes *shapes);

#ifdef __cplusplus
}
#endif
#endif
