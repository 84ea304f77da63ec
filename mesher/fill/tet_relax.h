// SPDX-License-Identifier: AGPL-3.0-or-later
// Moves all inner points at once: to the weighted mean of the centres of their tetrahedra (L. Chen and J. Xu, Optimal
// Delaunay triangulations, J. Comp. Math. 22, 2004), and down the gradient of the aspects.
#ifndef CUTWATER_MESHER_FILL_TET_RELAX_H
#define CUTWATER_MESHER_FILL_TET_RELAX_H

#include "mesher/fill/tet_judge.h"

#ifdef __cplusplus
extern "C" {
#endif

// Towards even spacing first, where `centres` is set, then in `evenings` steps towards even edges, of which the first
// goes `pull` of an edge and each further one less, and those beside partition planes in `beside` more.
typedef struct {
  int centres, evenings, beside;
  double pull;
} CwTetMoves;

// Moves all inner points but those that are as in a lattice, where nothing is left worse below the floor; then every
// tetrahedron below the limit is in the list, and every slender one in that of the shapes.
CwStatus cw_tet_relax(CwTetWork *w, CwTetShapes *shapes, CwTetMoves moves);

#ifdef __cplusplus
}
#endif
#endif
