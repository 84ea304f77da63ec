// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/triangle_bound.h"

#include <math.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"

double cw_inner_angle(const double from[3], const double to[3], const double m[3], const double n[3]) {
  double turn[3], along[3], cosine = cw_dot(m, n);
  if (cosine >= 0.0) return 90.0;
  cw_sub(to, from, along);
  cw_cross(m, n, turn);
  double sine = cw_dot(turn, along) / cw_norm(along); // above 0 where the boundary bends away from its normals
  return sine > 0.0 ? 180.0 - atan2(sine, cosine) / CW_DEGREE : 90.0;
}

double cw_triangle_bound(const double *const corner[3], const CwBoundSide side[3], double least) {
  double best = CW_TET_BOUND_MOST;
  for (int e = 0; e < 3; e++) best = fmin(best, 0.5 * side[e].angle);
  for (int e = 0; e < 3 && best < least; e++) {
    if (side[e].apex < 0) continue;
    // The normal points outward: (c - a) x (b - a) towards the fourth corner.
    const double *x[4] = {corner[0], corner[2], corner[1], side[e].at};
    CwTetShape shape;
    cw_tet_shape(x, &shape);
    double single = shape.dihedral_least;
    for (int k = 0; k < 3; k++) {
      if (side[k].apex != side[e].apex) single = fmin(single, 0.5 * side[k].angle);
    }
    best = fmax(best, single);
  }
  return best;
}
