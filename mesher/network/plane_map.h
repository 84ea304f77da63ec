// SPDX-License-Identifier: AGPL-3.0-or-later
// Plane coordinates of a partition plane: an isometry, so that meshes in (u,v) are meshes in space.
#pragma once

#include "mesher/common/clip.h"

typedef struct {
  double origin[3];
  double axis[3][3]; // u, v, normal: right-handed
} CwPlaneMap;

CwPlaneMap cw_plane_map_of(const CwPlane *plane);
// A CwSurfaceAt over a CwPlaneMap.
void cw_plane_map(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]);
void cw_plane_uv(const CwPlaneMap *map, const double x[3], double uv[2]);
