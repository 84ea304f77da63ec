// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/boundary_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/intersect.h"
#include "mesher/common/mix.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/predicates.h"
#include "mesher/common/vec.h"

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

// An edge of a triangle at its end of the smaller number.
typedef struct {
  int32_t high; // the other end
  int32_t sign; // +1: towards it
} Directed;

static int same_place(const double a[3], const double b[3]) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static uint64_t scatter(const double x[3]) {
  uint64_t hash = 0;
  for (int i = 0; i < 3; i++) {
    double value = x[i] + 0.0; // -0 is 0
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    hash = cw_mix(hash + CW_MIX_STEP + bits);
  }
  return hash;
}

// Fails where two points are at one place: they meet in a hash table.
static CwStatus check_points(const CwFillInput *input) {
  CwStatus status = CW_OK;
  int32_t *table = NULL; // 1 + point
  uint64_t capacity = 2 * (uint64_t)input->point_count + 1;
  CW_NEW(table, capacity);
  for (int32_t p = 0; p < input->point_count; p++) {
    const double *x = input->x[p];
    uint64_t k = (scatter(x) >> 32) * capacity >> 32;
    for (; table[k]; k = k + 1 < capacity ? k + 1 : 0)
      CW_REQUIRE(!same_place(input->x[table[k] - 1], x), CW_ERR_MESH,
                 "%s: two points of the boundary coincide at (%.6g, %.6g, %.6g) mm", input->name, CW_MM(x));
    table[k] = 1 + p;
  }
done:
  free(table);
  return status;
}

// Fails where an edge does not have as many triangles in one direction as in the other, or where two points coincide.
static CwStatus check_closed(const CwFillInput *input) {
  CwStatus status = CW_OK;
  Directed *edge = NULL;
  int64_t *start = NULL, count = 3 * (int64_t)input->triangle_count;
  int32_t *sum = NULL; // of the signs of the edges from one point to each other
  CW_TRY(check_points(input));
  CW_NEW(edge, count);
  CW_NEW(sum, input->point_count);
  CW_NEW(start, (int64_t)input->point_count + 2);
  CW_REQUIRE(input->triangle_count >= 4, CW_ERR_MESH, "%s: the boundary has %d triangles; at least 4 are needed",
             input->name, input->triangle_count);
  for (int64_t k = 0; k < count; k++) {
    const int32_t *p = input->triangle[k / 3];
    int32_t a = p[k % 3], b = p[(k + 1) % 3];
    start[(a < b ? a : b) + 2]++;
  }
  for (int32_t p = 0; p < input->point_count; p++) start[p + 2] += start[p + 1];
  for (int64_t k = 0; k < count; k++) { // leaves start[p + 1] at the end of the list of p
    const int32_t *p = input->triangle[k / 3];
    int32_t a = p[k % 3], b = p[(k + 1) % 3];
    edge[start[(a < b ? a : b) + 1]++] = a < b ? (Directed){b, 1} : (Directed){a, -1};
  }
  for (int32_t p = 0; p < input->point_count; p++) {
    for (int64_t k = start[p]; k < start[p + 1]; k++) sum[edge[k].high] += edge[k].sign;
    for (int64_t k = start[p]; k < start[p + 1]; k++) { // all sums are 0 again, or it fails
      const double *a = input->x[p], *b = input->x[edge[k].high];
      CW_REQUIRE(sum[edge[k].high] == 0, CW_ERR_MESH,
                 "%s: the boundary is open or turned over at the edge from (%.6g, %.6g, %.6g) to (%.6g, %.6g, "
                 "%.6g) mm",
                 input->name, CW_MM(a), CW_MM(b));
    }
  }
done:
  free(edge);
  free(start);
  free(sum);
  return status;
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
  CW_TRY(check_closed(input));
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
