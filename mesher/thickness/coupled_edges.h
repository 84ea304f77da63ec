// SPDX-License-Identifier: AGPL-3.0-or-later
// The open edges of flat interfaces between domains. Two polygons inscribed in one circle with other corners differ by
// more than the first layer is high, and the coupling's weights there are off. So CAD edges that two domains have in
// common along an interface are divided once, with the finer of both size fields, at the planes of either domain.
#pragma once

#include "mesher/boundary/boundary.h"

// Divides the edges along these patches of both domains, and adds them to `edges_a` and `edges_b`. Edges without a
// partner on the other side are left alone: those of the cylinder between rotor and stator, whose ends lie in planes
// that no division moves.
CwStatus cw_couple_open_edges(const CwBoundaryInput *a, const char *patch_a, CwOpenEdges *edges_a,
                              const CwBoundaryInput *b, const char *patch_b, CwOpenEdges *edges_b);
