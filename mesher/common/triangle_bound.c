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

int32_t cw_bound_neighbour(const CwBoundSurface *surface, int32_t t, int32_t a, int32_t b, int32_t *apex) {
  int32_t found = -1, count = 0;
  for (int32_t i = surface->start[a]; i < surface->start[a + 1]; i++) {
    const int32_t *corner = surface->triangle[surface->around[i]];
    if (surface->around[i] == t || (corner[0] != b && corner[1] != b && corner[2] != b)) continue;
    found = surface->around[i];
    count++;
  }
  if (count != 1) return -1;
  for (int k = 0; k < 3; k++) {
    int32_t corner = surface->triangle[found][k];
    if (corner != a && corner != b) *apex = corner;
  }
  return found;
}

double cw_bound_on(const CwBoundSurface *surface, int32_t t, double least) {
  const double(*x)[3] = surface->x;
  const int32_t *vertex = surface->triangle[t];
  const double *const corner[3] = {x[vertex[0]], x[vertex[1]], x[vertex[2]]};
  CwBoundSide side[3];
  double m[3], n[3];
  cw_normal(corner[0], corner[1], corner[2], m);
  for (int k = 0; k < 3; k++) {
    int32_t apex = -1, other = cw_bound_neighbour(surface, t, vertex[k], vertex[(k + 1) % 3], &apex);
    side[k] = (CwBoundSide){.angle = 90.0, .apex = -1};
    if (other < 0) continue;
    const int32_t *beyond = surface->triangle[other];
    cw_normal(x[beyond[0]], x[beyond[1]], x[beyond[2]], n);
    side[k] = (CwBoundSide){cw_inner_angle(corner[k], corner[(k + 1) % 3], m, n), apex, x[apex]};
  }
  return cw_triangle_bound(corner, side, least);
}
