// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layer_top_flip.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"
#include "pipeline/mesh/cell.h"

enum { SWEEPS = 12 };
static const double SHARE = 1.05 * CW_SMALL_WEIGHT; // of a triangle beside its neighbour, at least

// Least angle of a triangle: the one across from its shortest edge.
static double least_angle(const double (*x)[3], int32_t a, int32_t b, int32_t c) {
  const int32_t corner[3] = {a, b, c};
  double edge[3][3], square[3], n[3]; // edge k lies across from corner k
  int least = 0;
  for (int k = 0; k < 3; k++) {
    cw_sub(x[corner[(k + 2) % 3]], x[corner[(k + 1) % 3]], edge[k]);
    square[k] = cw_dot(edge[k], edge[k]);
    if (square[k] < square[least]) least = k;
  }
  const double *u = edge[(least + 1) % 3], *v = edge[(least + 2) % 3];
  cw_cross(u, v, n);
  return atan2(cw_norm(n), -cw_dot(u, v));
}

// Least scaled Jacobian over the six corners of the prism between wall and layer top; the fluid lies against the
// normal.
static double prism_quality(const double (*wall)[3], const double (*top)[3], int32_t a, int32_t b, int32_t c) {
  const int32_t corner[3] = {a, b, c};
  double least = 1;
  for (int level = 0; level < 2; level++) {
    const double(*x)[3] = level ? top : wall;
    for (int k = 0; k < 3; k++) {
      double u[3], v[3], n[3], column[3];
      cw_sub(x[corner[(k + 1) % 3]], x[corner[k]], u);
      cw_sub(x[corner[(k + 2) % 3]], x[corner[k]], v);
      cw_sub(wall[corner[k]], top[corner[k]], column);
      cw_unit(u);
      cw_unit(v);
      cw_unit(column);
      cw_cross(u, v, n);
      least = fmin(least, cw_dot(n, column));
    }
  }
  return least;
}

// The least share of two triangles in the area of both: where they are flat, the weight that checkMesh gives the face
// between the cells on them.
static double least_share(const double (*x)[3], const int32_t p[3], const int32_t q[3]) {
  double n[3], m[3];
  cw_normal(x[p[0]], x[p[1]], x[p[2]], n);
  cw_normal(x[q[0]], x[q[1]], x[q[2]], m);
  double a = cw_norm(n), b = cw_norm(m);
  return fmin(a, b) / (a + b);
}

static int flat_pair(const double (*x)[3], const int32_t p[3], const int32_t q[3]) {
  double n[3], m[3];
  cw_normal(x[p[0]], x[p[1]], x[p[2]], n);
  cw_normal(x[q[0]], x[q[1]], x[q[2]], m);
  cw_unit(n);
  cw_unit(m);
  return cw_dot(n, m) > cw_policy.crease_cosine;
}

// Whether the edge a-b between c (left) and d is better as c-d; `before`: least angle of the layer top now.
static int flip_helps(const double (*wall)[3], const double (*top)[3], double before, int32_t a, int32_t b, int32_t c,
                      int32_t d) {
  double after = fmin(least_angle(top, c, d, b), least_angle(top, d, c, a));
  if (after < cw_policy.top_flip_gain * before) return 0;
  const int32_t old[2][3] = {{a, b, c}, {b, a, d}}, new[2][3] = {{c, d, b}, {d, c, a}};
  if (least_share(top, new[0], new[1]) < SHARE) return 0;
  if (!flat_pair(top, old[0], old[1]) || !flat_pair(top, new[0], new[1])) return 0;
  if (!flat_pair(wall, old[0], old[1]) || !flat_pair(wall, new[0], new[1])) return 0;
  for (int k = 0; k < 2; k++) {
    if (!flat_pair(top, old[0], new[k]) || !flat_pair(wall, old[0], new[k])) return 0;
    if (prism_quality(wall, top, new[k][0], new[k][1], new[k][2]) < cw_policy.sound_quality) return 0;
  }
  return 1;
}

typedef struct {
  const double (*wall)[3], (*top)[3];
  const CwFlipMesh *mesh;
  const int64_t *group;
} Top;

// The corner of the triangle across side k of t; -1 where the side may not be flipped.
static int32_t across(const CwFlipMesh *mesh, const int64_t *group, int32_t t, int k) {
  int32_t u = mesh->near[t][k];
  if (u < 0 || group[t] != group[u]) return -1;
  return mesh->triangle[u][(cw_flip_corner(mesh, u, mesh->triangle[t][(k + 1) % 3]) + 2) % 3];
}

static double angle_of(const double (*top)[3], const int32_t corner[3]) {
  return least_angle(top, corner[0], corner[1], corner[2]);
}

// Whether a flip of one of the sides of a triangle helps.
static CwStatus judge_triangle(void *context, int32_t t, void *out) {
  const Top *top = context;
  const int32_t(*triangle)[3] = (const int32_t(*)[3])top->mesh->triangle, *corner = triangle[t];
  uint8_t *helps = out;
  if (top->group[t] < 0) return CW_OK;
  double angle = angle_of(top->top, corner);
  for (int k = 0; k < 3 && !*helps; k++) {
    int32_t a = corner[k], b = corner[(k + 1) % 3], c = corner[(k + 2) % 3];
    int32_t d = across(top->mesh, top->group, t, k);
    if (d < 0 || c == d) continue;
    double before = fmin(angle, angle_of(top->top, triangle[top->mesh->near[t][k]]));
    *helps = (uint8_t)flip_helps(top->wall, top->top, before, a, b, c, d);
  }
  return CW_OK;
}

CwStatus cw_layer_top_flip(const CwContext *context, const double (*wall)[3], const double (*top)[3],
                           int32_t triangle_count, CwFlipMesh *mesh, const int64_t *group, int32_t *flips) {
  CwStatus status = CW_OK;
  int32_t(*const triangle)[3] = mesh->triangle;
  uint8_t *fresh = NULL; // triangles to look at in this sweep and in the next
  *flips = 0;
  CW_NEW(fresh, triangle_count);
  Top given = {wall, top, mesh, group};
  CW_TRY(cw_parallel_for(context, "layers: flips", triangle_count, sizeof *fresh, judge_triangle, &given, fresh));
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    int32_t made = 0;
    for (int32_t t = 0; t < triangle_count; t++) {
      if (!fresh[t]) continue;
      int turned = 0;
      for (int k = 0; k < 3 && !turned; k++) {
        int32_t u = mesh->near[t][k], d = across(mesh, group, t, k);
        if (d < 0) continue;
        int32_t a = triangle[t][k], b = triangle[t][(k + 1) % 3], c = triangle[t][(k + 2) % 3];
        double before = fmin(angle_of(top, triangle[t]), angle_of(top, triangle[u]));
        if (c == d || !flip_helps(wall, top, before, a, b, c, d) || cw_flip_joined(mesh, t, c, d)) continue;
        cw_flip(mesh, t, k, u);
        fresh[u] = 1;
        for (int i = 0; i < 3; i++) {
          if (mesh->near[t][i] >= 0) fresh[mesh->near[t][i]] = 1;
          if (mesh->near[u][i] >= 0) fresh[mesh->near[u][i]] = 1;
        }
        turned = 1;
      }
      fresh[t] = (uint8_t)turned;
      made += turned;
    }
    *flips += made;
    if (made == 0) break;
  }
done:
  free(fresh);
  return status;
}
