// SPDX-License-Identifier: AGPL-3.0-or-later
// The periodic image of a region: the same cells over turned points. Shared points get the numbers and the very bits
// that the boundary has there, so that the copy fits its neighbours.
#pragma once

#include "mesher/region/region_build.h"

// Hex fingerprint of the copy of `first`, the mesh of the first region of an image set, `turns` turns on: of what both
// follow from.
void cw_region_copy_fingerprint(const CwRegionContext *context, const CwRegionMesh *first, int32_t turns,
                                char fingerprint[CW_HASH_TEXT]);

// Makes that copy of the mesh that it is given, in its place, with its fingerprint. Fails with CW_ERR_FAULT where a
// shared point of the boundary does not lie where the turn takes it; then the mesh is neither.
CwStatus cw_region_turn(const CwRegionContext *context, int32_t turns, int32_t number, const char *fingerprint,
                        CwRegionMesh *mesh);
