// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/network/plane_map.h"

#include <math.h>

#include "mesher/common/vec.h"

CwPlaneMap cw_plane_map_of(const CwPlane *plane) {
  CwPlaneMap map;
  int least = 0;
  for (int k = 1; k < 3; k++) {
    if (fabs(plane->normal[k]) < fabs(plane->normal[least])) least = k;
  }
  double axis[3] = {least == 0, least == 1, least == 2};
  cw_cross(axis, plane->normal, map.axis[0]);
  cw_unit(map.axis[0]);
  cw_cross(plane->normal, map.axis[0], map.axis[1]);
  cw_copy(plane->normal, map.axis[2]);
  for (int k = 0; k < 3; k++) map.origin[k] = plane->offset * plane->normal[k];
  return map;
}

void cw_plane_map(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  const CwPlaneMap *map = context;
  for (int k = 0; k < 3; k++) x[k] = map->origin[k] + uv[0] * map->axis[0][k] + uv[1] * map->axis[1][k];
  if (xu) cw_copy(map->axis[0], xu);
  if (xv) cw_copy(map->axis[1], xv);
}

void cw_plane_uv(const CwPlaneMap *map, const double x[3], double uv[2]) {
  double d[3];
  cw_sub(x, map->origin, d);
  uv[0] = cw_dot(d, map->axis[0]);
  uv[1] = cw_dot(d, map->axis[1]);
}
