// SPDX-License-Identifier: AGPL-3.0-or-later
// Improves the mesh of a patch whose points are in place: sweeps of flips, splits, removals and smoothing
// with lengths and angles in space; then the worst triangles one by one.
#pragma once

#include "mesher/surface/patch_work.h"

CwStatus cw_patch_improve(CwPatchWork *work);
