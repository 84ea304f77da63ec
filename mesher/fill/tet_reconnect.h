// SPDX-License-Identifier: AGPL-3.0-or-later
// Removal of an edge or a face of tetrahedra where that raises the least quality round it: of an edge with up to eight
// tetrahedra by the best triangulation of its ring (G. Klincsek, 1980; J. Shewchuk, Two discrete optimization
// algorithms for the topological improvement of tetrahedral meshes, 2002), of a face by a new edge (2-3).
#pragma once

#include "mesher/fill/tet_work.h"

// Removes the edge a-b of t. *done_it: 1 where that was done.
CwStatus cw_tet_remove_edge(CwTetWork *w, int32_t t, int32_t a, int32_t b, int *done_it);
// Two tetrahedra at face i of t become three round a new edge.
CwStatus cw_tet_remove_face(CwTetWork *w, int32_t t, int i, int *done_it);
