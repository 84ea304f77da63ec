// SPDX-License-Identifier: AGPL-3.0-or-later
// Improves the mesh of a patch.
#pragma once

#include "mesher/surface/patch_work.h"

// Of a patch that has its given points alone: on noses narrower than the wanted edges, where rows of new points find no
// room, triangles from side to side get points between, beside those of the sides. Else the normals of the surface at
// their corners stand square to them and tell no flip which way is up. Where there is no room for that either, edges
// from side to side become as short as flips make them.
CwStatus cw_patch_divide_noses(CwPatchWork *work);

// Of a patch whose points are in place: sweeps of flips, splits, removals and smoothing with lengths and angles in
// space; then the worst triangles one by one.
CwStatus cw_patch_improve(CwPatchWork *work);
