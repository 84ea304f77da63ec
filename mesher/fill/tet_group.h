// SPDX-License-Identifier: AGPL-3.0-or-later
// Inner to the improvement of tetrahedra: eight of them side by side in single precision, which is enough for where
// points should go and for what is well shaped.
#pragma once

#include <stdint.h>

#include "mesher/common/simd_4f.h"
#include "mesher/fill/delaunay.h"

enum { CW_TET_GROUP = 8 };

// A list of tetrahedra of the mesh ends with a group's worth of room, filled with any of them; those that come later
// are prefetched. `place` and `sum` are by point, with 0 as the fourth coordinate of a place. Sums are in the order of
// the list and the same to the bit on any processor.

// Adds to the sums of each corner the weighted displacement, in x, y, z, to where its tetrahedra want it, and the
// weight. A tetrahedron wants its points at the centre of its circumscribed sphere. Its weight is its volume over the
// cube of its mean edge: equal for all that are well shaped, large or small, so that the spacing keeps its gradient;
// nothing for flat ones, whose spheres are anywhere.
void cw_tet_add_centres(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, Cw4f *sum);
// A tetrahedron wants the ends of its longest edge nearer to one another, and those of its shortest edge farther apart:
// down the gradient of their ratio, so that slender ones count for more.
void cw_tet_add_pulls(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, Cw4f *sum);

// Of a group of tetrahedra: as cw_tet_quality, but for rounding where that is above 0.1 or so, and what is less, or not
// a number, elsewhere; 0 where the square of an edge is not above too_short. slender: -1 where the square of the
// longest edge is above slender_square times that of the shortest one, else 0.
void cw_tet_group_qualities(const CwTetMesh *mesh, const int32_t list[CW_TET_GROUP], const Cw4f *place, float too_short,
                            float slender_square, float quality[CW_TET_GROUP], int32_t slender[CW_TET_GROUP]);
