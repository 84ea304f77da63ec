// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_bound.h"

#include <stdlib.h>

#include "mesher/common/vec.h"

// The edge of the neighbour at each edge, as 3 * triangle + edge; -1 where there is not just one. Edges stand in lists
// of their lower ends, which are short.
static CwStatus find_neighbours(const CwFillInput *boundary, int32_t (*neighbour)[3]) {
  CwStatus status = CW_OK;
  int32_t *start = NULL, count = 3 * boundary->triangle_count;
  struct {
    int32_t high, edge; // the other end; 3 * triangle + edge
  } *list = NULL;
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
    int32_t at = start[(a < b ? a : b) + 1]++;
    list[at].high = a < b ? b : a;
    list[at].edge = k;
  }
  for (int32_t p = 0; p < boundary->point_count; p++) {
    for (int32_t i = start[p]; i < start[p + 1]; i++) {
      int32_t k = list[i].edge, same = 0, other = -1;
      for (int32_t j = start[p]; j < start[p + 1]; j++) {
        if (j == i || list[j].high != list[i].high) continue;
        other = list[j].edge;
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

// Bound of the tetrahedron on a triangle; anything not below `least` where it is none of the worst.
static double bound_of(const CwFillInput *boundary, const double (*normal)[3], int32_t t, const int32_t neighbour[3],
                       double least) {
  const double(*at)[3] = boundary->x;
  const double *corner[3];
  CwBoundSide side[3];
  for (int e = 0; e < 3; e++) corner[e] = at[boundary->triangle[t][e]];
  for (int e = 0; e < 3; e++) {
    side[e] = (CwBoundSide){.angle = 90.0, .apex = -1};
    if (neighbour[e] < 0) continue;
    int32_t other = neighbour[e] / 3, apex = boundary->triangle[other][(neighbour[e] + 2) % 3];
    side[e] = (CwBoundSide){cw_inner_angle(corner[e], corner[(e + 1) % 3], normal[t], normal[other]), apex, at[apex]};
  }
  return cw_triangle_bound(corner, side, least);
}

CwStatus cw_tet_bound(const CwFillInput *boundary, double *degrees, int32_t *worst) {
  CwStatus status = CW_OK;
  int32_t(*neighbour)[3] = NULL;
  double(*normal)[3] = NULL;
  *degrees = CW_TET_BOUND_MOST;
  *worst = -1;
  CW_NEW(neighbour, boundary->triangle_count);
  CW_NEW(normal, boundary->triangle_count);
  CW_TRY(find_neighbours(boundary, neighbour));
  for (int32_t t = 0; t < boundary->triangle_count; t++) {
    const int32_t *corner = boundary->triangle[t];
    cw_normal(boundary->x[corner[0]], boundary->x[corner[1]], boundary->x[corner[2]], normal[t]);
  }
  for (int32_t t = 0; t < boundary->triangle_count; t++) {
    double bound = bound_of(boundary, (const double(*)[3])normal, t, neighbour[t], *degrees);
    if (bound < *degrees) *degrees = bound, *worst = t;
  }
done:
  free(normal);
  free(neighbour);
  return status;
}
