// SPDX-License-Identifier: AGPL-3.0-or-later
// Brings boundary triangles that the Delaunay mesh does not have into it: by flips, and where these are stuck
// by clearing what crosses the triangle and filling both sides of it anew from a new point each.
#ifndef CUTWATER_MESHER_KERNEL_RECOVER_H
#define CUTWATER_MESHER_KERNEL_RECOVER_H

#include "mesher/kernel_facets.h"

#ifdef __cplusplus
extern "C" {
#endif

// Takes the missing ones of *facets, edges first; facets that are there stay. Those that cannot be recovered
// stay missing (see cw_facets_locate afterwards). Another `round` tries other flips, from the third on also
// new points, whose sources go from *source_count on. Deterministic.
CwStatus cw_kernel_recover(CwDelaunay *mesh, const CwFacets *facets, int round, int32_t *source_count);

#ifdef __cplusplus
}
#endif
#endif
