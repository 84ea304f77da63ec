// SPDX-License-Identifier: AGPL-3.0-or-later
// Moves all inner points at once: to the weighted mean of the centres of their tetrahedra (L. Chen and J. Xu, Optimal
// Delaunay triangulations, J. Comp. Math. 22, 2004), and down the gradient of the aspects.
#pragma once

#include "mesher/fill/tet_judge.h"

// Which moves: towards even spacing; then towards even edges, in `even_steps` ever shorter steps (policy_table.h).
enum { CW_TET_CENTRES = 1, CW_TET_EDGES = 2 };

// Moves all inner points but those that are as in a lattice, where nothing is left worse below the floor; then every
// tetrahedron below the limit is in the list, and every slender one in that of the shapes.
CwStatus cw_tet_relax(CwTetWork *w, CwTetShapes *shapes, int moves);
