// SPDX-License-Identifier: AGPL-3.0-or-later
// The search for what single changes cannot mend: patches of a few hundred tetrahedra round the worst are disturbed and
// improved again, hundreds of times; what is better in all is kept (iterated local search; H. Lourenco, O. Martin and
// T. Stuetzle, in: Handbook of Metaheuristics, 2003).
#ifndef CUTWATER_MESHER_FILL_TET_SEARCH_H
#define CUTWATER_MESHER_FILL_TET_SEARCH_H

#include "mesher/fill/tet_work.h"

#ifdef __cplusplus
extern "C" {
#endif

// Where dihedral angles below 13 degrees are left in the list, or below 18 and below 0.85 of what the boundary allows
// (tet_bound.h); then where checkMesh calls determinants small, for which no angle below 18 degrees becomes less. A
// place below 12 degrees is begun with again while the boundary allows clearly more than is reached. The same every
// time. Takes about half as long as the fill, by the numbers of tries in policy_table.h.
CwStatus cw_tet_search(CwTetWork *w);

#ifdef __cplusplus
}
#endif
#endif
