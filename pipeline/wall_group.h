// SPDX-License-Identifier: AGPL-3.0-or-later
// Which group of the case's walls a patch belongs to: the mesher sets its layers by it, the exporter its wall
// functions.
#ifndef CUTWATER_PIPELINE_WALL_GROUP_H
#define CUTWATER_PIPELINE_WALL_GROUP_H

#include "pipeline/case.h"

#ifdef __cplusplus
extern "C" {
#endif

// By the name of a wall, as docs/file-formats.md lists them; those not named elsewhere are the volute's.
const CwWallGroup *cw_wall_group(const CwWalls *walls, const char *patch);

// Whether a first height is left open: neither given nor by a y+.
int cw_walls_auto(const CwWalls *walls);

#ifdef __cplusplus
}
#endif
#endif
