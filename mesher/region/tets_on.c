// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/tets_on.h"

#include <stdlib.h>

#include "mesher/fill/tet_topology.h"

CwStatus cw_tets_on(int32_t point_count, int32_t triangle_count, const int32_t (*triangle)[3], int32_t tet_count,
                    const int32_t (*tet)[4], int32_t *on) {
  CwStatus status = CW_OK;
  CwTetSide *side = NULL;    // of each triangle
  uint8_t *is_corner = NULL; // of a triangle
  CW_NEW_UNSET(side, triangle_count);
  CW_NEW(is_corner, point_count);
  for (int32_t t = 0; t < triangle_count; t++) {
    side[t] = cw_side_of(triangle[t][0], triangle[t][1], triangle[t][2], t);
    on[t] = -1;
    for (int k = 0; k < 3; k++) is_corner[triangle[t][k]] = 1;
  }
  qsort(side, (size_t)triangle_count, sizeof *side, cw_tet_sides_compare);
  for (int32_t t = 0; t < tet_count; t++) {
    const int32_t *corner = tet[t];
    if (is_corner[corner[0]] + is_corner[corner[1]] + is_corner[corner[2]] + is_corner[corner[3]] < 3) continue;
    for (int k = 0; k < 4; k++) {
      const CwTetSide face = cw_tet_side(corner, k, t);
      const CwTetSide *found = bsearch(&face, side, (size_t)triangle_count, sizeof *side, cw_tet_sides_compare);
      if (found) on[found->owner] = t;
    }
  }
done:
  free(side);
  free(is_corner);
  return status;
}
