// SPDX-License-Identifier: AGPL-3.0-or-later
// Opens grooves of the front: places where two triangles of it stand so narrow over their edge that only flat
// tetrahedra fit between, though all prisms are sound and no triangle is a needle. What made them may be the repair,
// the choice of columns on the seams of turned copies, or a flip.
#ifndef CUTWATER_MESHER_SKELETON_FRONT_OPEN_H
#define CUTWATER_MESHER_SKELETON_FRONT_OPEN_H

#include "mesher/layers/layers.h"
#include "mesher/skeleton/skeleton.h"

#define CW_FRONT_NARROW 20.0 // degrees: triangles of the front that bound their tetrahedra below that are opened

// Turns columns at grooves and changes their heights by a tenth, never below `least` of `wall`, each up to eight times
// where the least bound of the triangles round it rises by that, up to 26 degrees; alike in all turned copies. All
// stays as it was where the front would cross something. *opened: columns that moved, copies not counted. `wall` is
// that of the skeleton. Collective.
CwStatus cw_front_open(CwSkeleton *skeleton, const CwLayerInput *wall, int32_t *opened);

// What the front allows a tetrahedron on its triangle t (degrees; triangle_bound.h), or anything not below `least`.
// start, around: triangles at each wall vertex, as in CwIncident.
double cw_front_bound(int32_t t, const int32_t (*triangle)[3], const double (*front)[3], const int32_t *start,
                      const int32_t *around, double least);

#endif
