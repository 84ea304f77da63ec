// SPDX-License-Identifier: AGPL-3.0-or-later
// Inner points of a region before it is filled: a body-centred cubic lattice on an octree that follows the
// size field. Its tetrahedra have edges in the ratio 1.155 and dihedral angles of 60 and 90 degrees; only the
// shell between it and the boundary is left to optimise. The boundary is looked at cell by coarse cell, and a
// whole line of the lattice is cut by it at once.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/fill.h"

#ifdef __cplusplus
extern "C" {
#endif

// Points inside the closed boundary that keep a distance from it: none nearer than half of h, or of the edges of the
// triangle there where these are shorter (layer tops have finer triangles than the field wants), none in the smallest
// sphere through the corners of a boundary triangle, so that the Delaunay tetrahedra of all points hold the boundary
// (fill_reach.h). The octree's spacing is fitted so that there are as many points as the size field wants, whatever
// powers of two are near it. The offset points of the last triangles (offset_points.h) come after the points of the
// lattice, which keep a distance from them. `clearance` (1 as a rule) multiplies the distances to the boundary. *site,
// where not NULL: the place of each in the lattice. Deterministic. Caller frees *x and *site.
CwStatus cw_fill_points(const CwFillInput *input, double clearance, int32_t *count, double (**x)[3],
                        CwLatticeSite **site);

#ifdef __cplusplus
}
#endif
