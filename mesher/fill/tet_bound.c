// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_bound.h"

#include <stdlib.h>

#include "mesher/common/incident.h"
#include "mesher/common/vec.h"

// The triangle with the edge a-b beside triangle t, and its third corner; -1 where there is not just one.
static int32_t neighbour_of(const CwFillInput *boundary, const CwIncident *around, int32_t t, int32_t a, int32_t b,
                            int32_t *apex) {
  int32_t found = -1, count = 0;
  for (int32_t i = around->start[a]; i < around->start[a + 1]; i++) {
    const int32_t *corner = boundary->triangle[around->triangle[i]];
    for (int k = 0; k < 3 && around->triangle[i] != t; k++) {
      int32_t p = corner[k], q = corner[(k + 1) % 3];
      if (!(p == a && q == b) && !(p == b && q == a)) continue;
      found = around->triangle[i];
      *apex = corner[(k + 2) % 3];
      count++;
    }
  }
  return count == 1 ? found : -1;
}

// Bound of the tetrahedron on a triangle; anything not below `least` where it is none of the worst.
static double bound_of(const CwFillInput *boundary, const CwIncident *around, const double (*normal)[3], int32_t t,
                       double least) {
  const double(*at)[3] = boundary->x;
  const int32_t *vertex = boundary->triangle[t];
  const double *const corner[3] = {at[vertex[0]], at[vertex[1]], at[vertex[2]]};
  CwBoundSide side[3];
  for (int e = 0; e < 3; e++) {
    int32_t apex = -1, other = neighbour_of(boundary, around, t, vertex[e], vertex[(e + 1) % 3], &apex);
    side[e] = (CwBoundSide){.angle = 90.0, .apex = -1};
    if (other < 0) continue;
    side[e] = (CwBoundSide){cw_inner_angle(corner[e], corner[(e + 1) % 3], normal[t], normal[other]), apex, at[apex]};
  }
  return cw_triangle_bound(corner, side, least);
}

CwStatus cw_tet_bound(const CwFillInput *boundary, double *degrees, int32_t *worst) {
  CwStatus status = CW_OK;
  CwIncident around = {0};
  double(*normal)[3] = NULL;
  *degrees = CW_TET_BOUND_MOST;
  *worst = -1;
  CW_NEW(normal, boundary->triangle_count);
  CW_TRY(cw_incident_make(boundary->point_count, boundary->triangle_count, boundary->triangle, &around));
  for (int32_t t = 0; t < boundary->triangle_count; t++) {
    const int32_t *corner = boundary->triangle[t];
    cw_normal(boundary->x[corner[0]], boundary->x[corner[1]], boundary->x[corner[2]], normal[t]);
  }
  for (int32_t t = 0; t < boundary->triangle_count; t++) {
    double bound = bound_of(boundary, &around, (const double(*)[3])normal, t, *degrees);
    if (bound < *degrees) *degrees = bound, *worst = t;
  }
done:
  free(normal);
  cw_incident_free(&around);
  return status;
}
