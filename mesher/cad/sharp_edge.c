// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/sharp_edge.h"

#include <math.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"

// The angle through the wall at edge k of triangle t, degrees; 180 where the wall is not convex.
static double wedge_at(const CwBackground *background, int32_t t, int k) {
  int32_t other = background->neighbour[t][k];
  double normal[2][3], away[3], centre[3];
  cw_background_normal(background, t, normal[0]);
  cw_background_normal(background, other, normal[1]);
  cw_background_area(background, other, centre);
  cw_sub(centre, background->x[background->triangle[t][k]], away);
  if (cw_dot(away, normal[0]) <= 0) return 180;
  return 180 - acos(fmax(-1, fmin(1, cw_dot(normal[0], normal[1])))) / CW_DEGREE;
}

CwSharpEdge cw_sharpest_edge(const CwCad *cad, const CwBackground *background) {
  CwSharpEdge edge = {.angle = 180};
  for (int32_t t = 0; t < background->triangle_count; t++) {
    int face = background->face[t];
    for (int k = 0; k < 3 && cw_cad_face_is_wall(cad, face); k++) {
      int other = background->face[background->neighbour[t][k]];
      double angle = cw_cad_face_is_wall(cad, other) ? wedge_at(background, t, k) : 180;
      if (angle >= edge.angle) continue;
      edge = (CwSharpEdge){.angle = angle, .face = {face, other}};
      cw_copy(background->x[background->triangle[t][k]], edge.at);
    }
  }
  return edge;
}
