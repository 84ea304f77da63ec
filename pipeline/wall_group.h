// SPDX-License-Identifier: AGPL-3.0-or-later
// Which group of the case's walls a patch belongs to: the mesher sets its layers by it, the exporter its wall
// functions.
#pragma once

#include "pipeline/case.h"
#include "pipeline/model.h"

// What the case asks of the walls of a group, blade to pipe.
const CwWallGroup *cw_wall_group(const CwWalls *walls, CwPatchGroup group);

// The same of a patch, whose own y+, where it has one, stands for a y+ or first height of its group.
CwWallGroup cw_patch_walls(const CwWalls *walls, const CwModelPatch *patch);

// Whether a first height is left open: neither given nor by a y+.
int cw_walls_auto(const CwWalls *walls);
