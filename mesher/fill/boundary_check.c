// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/boundary_check.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/intersect.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/predicates.h"
#include "mesher/common/vec.h"
#include "mesher/fill/fill_shape.h"

static void middle(const CwFillInput *input, int32_t triangle, double mm[3]) {
  for (int i = 0; i < 3; i++) {
    mm[i] = 0.0;
    for (int k = 0; k < 3; k++) mm[i] += cw_mm(input->x[input->triangle[triangle][k]][i]) / 3.0;
  }
}

// On one line, exactly: then so are all three shadows on the planes of the axes. Only thin ones are put to that
// test.
static int has_no_area(const double a[3], const double b[3], const double c[3]) {
  double u[3], v[3], n[3];
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  cw_cross(u, v, n);
  if (cw_dot(n, n) > 1e-20 * cw_dot(u, u) * cw_dot(v, v)) return 0;
  for (int i = 0; i < 3; i++) { // a point off the plane of two shadows tells whether the three are on one line
    double p[3][3], top[3] = {0, 0, 0};
    const double *x[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
      cw_copy(x[k], p[k]);
      p[k][i] = 0.0;
    }
    top[i] = 1.0;
    if (cw_orient3d(p[0], p[1], p[2], top) != 0) return 0;
  }
  return 1;
}

CwStatus cw_boundary_check(const CwFillInput *input) {
  CwStatus status = CW_OK;
  double mm[3];
  for (int32_t p = 0; p < input->point_count; p++) {
    const double *x = input->x[p];
    CW_REQUIRE(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]), CW_ERR_MESH,
               "%s: boundary point %d is not finite: (%g, %g, %g) mm", input->name, p, CW_MM(x));
  }
  for (int32_t t = 0; t < input->triangle_count; t++) {
    const int32_t *p = input->triangle[t];
    for (int k = 0; k < 3; k++)
      CW_REQUIRE(p[k] >= 0 && p[k] < input->point_count && p[k] != p[(k + 1) % 3], CW_ERR_MESH,
                 "%s: boundary triangle %d has points %d, %d, %d; three different ones from 0 to %d are allowed",
                 input->name, t, p[0], p[1], p[2], input->point_count - 1);
    if (!has_no_area(input->x[p[0]], input->x[p[1]], input->x[p[2]])) continue;
    middle(input, t, mm);
    status = CW_FAIL(CW_ERR_MESH,
                     "%s: the boundary triangle at (%.6g, %.6g, %.6g) mm has no area: its corners lie on one line",
                     input->name, mm[0], mm[1], mm[2]);
    goto done;
  }
  CW_TRY(cw_fill_check_closed(input));
done:
  return status;
}

CwStatus cw_boundary_check_crossing(const CwFillInput *input) {
  CwStatus status = CW_OK;
  int32_t count = 0, (*pair)[2] = NULL;
  double mm[2][3];
  CW_TRY(cw_self_intersections(input->point_count, input->x, input->triangle_count, input->triangle, &count, &pair));
  if (count == 0) goto done;
  for (int k = 0; k < 2; k++) middle(input, pair[0][k], mm[k]);
  status = CW_FAIL(CW_ERR_MESH,
                   "%s: the boundary crosses itself: %d pairs of triangles, the first at (%.6g, %.6g, %.6g) and "
                   "(%.6g, %.6g, %.6g) mm; triangles may meet only in common edges and corners",
                   input->name, count, mm[0][0], mm[0][1], mm[0][2], mm[1][0], mm[1][1], mm[1][2]);
done:
  free(pair);
  return status;
}
