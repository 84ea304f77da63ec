// SPDX-License-Identifier: AGPL-3.0-or-later
// The search for what single changes cannot mend: patches of a few hundred tetrahedra round the worst are disturbed and
// improved again, hundreds of times; what is better in all is kept (iterated local search; H. Lourenco, O. Martin and
// T. Stuetzle, in: Handbook of Metaheuristics, 2003).
#pragma once

#include "mesher/fill/tet_work.h"

// Where dihedral angles below flat_angle are left in the list, or below search_wanted where the boundary allows more
// (tet_bound.h); then where checkMesh calls determinants small of angles of flat_angle or more, for which no angle
// below search_wanted becomes less. Below flat_angle a place is begun with again while the boundary allows more than is
// reached. The same every time; policy_table.h has the angles and the numbers of tries.
CwStatus cw_tet_search(CwTetWork *w);
