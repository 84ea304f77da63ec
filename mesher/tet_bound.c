// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/tet_bound.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/quality.h"
#include "mesher/vec.h"

static const double degree = 3.14159265358979323846 / 180.0;

// The edge of the neighbour at each edge, as 3 * triangle + edge; -1 where there is not just one. Edges stand in lists
// of their lower ends, which are short.
static CwStatus find_neighbours(const CwFillInput *boundary, int32_t (*neighbour)[3]) {
  CwStatus status = CW_OK;
  int32_t *start = NULL, *list = NULL, count = 3 * boundary->triangle_count;
  const int32_t(*triangle)[3] = boundary->triangle;
  CW_NEW(start, boundary->point_count + 2);
  CW_NEW(list, count);
  for (int32_t k = 0; k < count; k++) {
    int32_t a = triangle[k / 3][k % 3], b = triangle[k / 3][(k + 1) % 3];
    start[(a < b ? a : b) + 2]++;
    neighbour[k / 3][k % 3] = -1;
  }
  for (int32_t p = 0; p < boundary->point_count; p++) start[p + 2] += start[p + 1];
  for (int32_t k = 0; k < count; k++) { // leaves start[p + 1] at the end of the list of p
    int32_t a = triangle[k / 3][k % 3], b = triangle[k / 3][(k + 1) % 3];
    list[start[(a < b ? a : b) + 1]++] = k;
  }
  for (int32_t p = 0; p < boundary->point_count; p++) {
    for (int32_t i = start[p]; i < start[p + 1]; i++) {
      int32_t k = list[i], same = 0, other = -1;
      int32_t high = triangle[k / 3][k % 3] + triangle[k / 3][(k + 1) % 3] - p;
      for (int32_t j = start[p]; j < start[p + 1]; j++) {
        int32_t l = list[j];
        if (l == k || triangle[l / 3][l % 3] + triangle[l / 3][(l + 1) % 3] - p != high) continue;
        other = l;
        same++;
      }
      if (same == 1) neighbour[k / 3][k % 3] = other;
    }
  }
done:
  free(start);
  free(list);
  return status;
}

static void normal_of(const CwFillInput *boundary, int32_t t, double n[3]) {
  const double *a = boundary->x[boundary->triangle[t][0]];
  double u[3], v[3];
  cw_sub(boundary->x[boundary->triangle[t][1]], a, u);
  cw_sub(boundary->x[boundary->triangle[t][2]], a, v);
  cw_cross(u, v, n);
}

// Inner angle at an edge between two triangles, degrees from 0 to 360.
static double inner_angle(const CwFillInput *boundary, int32_t t, int edge, int32_t other) {
  double m[3], n[3], turn[3], along[3];
  cw_sub(boundary->x[boundary->triangle[t][(edge + 1) % 3]], boundary->x[boundary->triangle[t][edge]], along);
  normal_of(boundary, t, m);
  normal_of(boundary, other, n);
  cw_cross(m, n, turn); // along the edge where the boundary bends away from its normals
  return 180.0 - atan2(cw_dot(turn, along) / cw_norm(along), cw_dot(m, n)) / degree;
}

// Bound of the tetrahedron on a triangle.
static double bound_of(const CwFillInput *boundary, int32_t t, const int32_t neighbour[3]) {
  const int32_t *corner = boundary->triangle[t];
  double angle[3], single[3], best = INFINITY;
  int32_t apex[3];
  for (int e = 0; e < 3; e++) {
    int32_t other = neighbour[e];
    apex[e] = -1;
    angle[e] = 360.0;
    if (other >= 0) {
      apex[e] = boundary->triangle[other / 3][(other % 3 + 2) % 3];
      angle[e] = inner_angle(boundary, t, e, other / 3);
    }
    best = fmin(best, 0.5 * angle[e]);
  }
  for (int e = 0; e < 3; e++) {
    if (apex[e] < 0) continue;
    // The normal points outward: (c - a) x (b - a) towards the fourth corner.
    const double *x[4] = {boundary->x[corner[0]], boundary->x[corner[2]], boundary->x[corner[1]], boundary->x[apex[e]]};
    CwTetShape shape;
    cw_tet_shape(x, &shape);
    single[e] = shape.dihedral_least;
    for (int other = 0; other < 3; other++) {
      if (apex[other] != apex[e]) single[e] = fmin(single[e], 0.5 * angle[other]);
    }
    best = fmax(best, single[e]);
  }
  return best;
}

CwStatus cw_tet_bound(const CwFillInput *boundary, double *degrees, int32_t *worst) {
  CwStatus status = CW_OK;
  int32_t(*neighbour)[3] = NULL;
  *degrees = INFINITY;
  *worst = -1;
  CW_NEW(neighbour, boundary->triangle_count);
  CW_TRY(find_neighbours(boundary, neighbour));
  for (int32_t t = 0; t < boundary->triangle_count; t++) {
    double bound = bound_of(boundary, t, neighbour[t]);
    if (bound < *degrees) *degrees = bound, *worst = t;
  }
done:
  free(neighbour);
  return status;
}
