// SPDX-License-Identifier: AGPL-3.0-or-later
// The rims of flat interfaces between domains. Two polygons inscribed in one circle with other corners differ by more
// than the first layer is high, and the coupling's weights there are off. So CAD edges that two domains have in
// common along an interface are divided once, with the finer of both size fields, at the planes of either domain.
#ifndef CUTWATER_MESHER_HEIGHTS_COUPLED_RIM_H
#define CUTWATER_MESHER_HEIGHTS_COUPLED_RIM_H

#include "mesher/skeleton/skeleton.h"

// Divides the edges along the patches `patch` of both skeletons, whose networks are made, and adds them to their rims.
// Edges without a partner on the other side are left alone: those of the cylinder between rotor and stator, whose
// ends lie in planes that no division moves.
CwStatus cw_couple_rims(CwSkeleton *a, const char *patch_a, CwSkeleton *b, const char *patch_b);

#endif
