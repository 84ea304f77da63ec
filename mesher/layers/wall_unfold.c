// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/wall_unfold.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/policy.h"

enum { SWEEPS = 8 };
static const double FLATTEST = 0.02; // thickness over base of a triangle that a flip may make

typedef struct {
  const double (*x)[3];
  CwFlipMesh mesh;
  int32_t *around; // a triangle at each vertex; -1: none may be flipped there
  double *open;    // cosine of each vertex, where it is not stale
  uint8_t *stale;
} Wall;

// Least cosine of the most normal direction at v; 2 where more faces meet than are worth a look.
static double openness(const Wall *wall, int32_t v) {
  double normal[CW_LAYER_NORMALS][3], g[3];
  int count = 0;
  for (int way = 0; way < 2; way++) {
    int32_t t = wall->around[v];
    do {
      const int32_t *c = wall->mesh.triangle[t];
      int k = cw_flip_corner(&wall->mesh, t, v);
      if (way == 0 || t != wall->around[v]) {
        if (count == CW_LAYER_NORMALS) return 2;
        cw_normal(wall->x[c[0]], wall->x[c[2]], wall->x[c[1]], normal[count]); // into the fluid
        cw_unit(normal[count++]);
      }
      t = wall->mesh.near[t][way ? k : (k + 2) % 3];
    } while (t >= 0 && t != wall->around[v]);
    if (t >= 0) break;
  }
  return cw_layers_most_normal(count, (const double(*)[3])normal, 0, NULL, g);
}

static CwStatus judge_vertex(void *context, int32_t v, void *out) {
  const Wall *wall = context;
  *(double *)out = wall->around[v] < 0 ? 2 : openness(wall, v);
  return CW_OK;
}

static double least_openness(const Wall *wall, const int32_t corner[4]) {
  double least = 2;
  for (int k = 0; k < 4; k++) least = fmin(least, openness(wall, corner[k]));
  return least;
}

static int is_fair(const double (*x)[3], int32_t a, int32_t b, int32_t c) {
  double u[3], v[3], w[3], n[3];
  cw_sub(x[b], x[a], u);
  cw_sub(x[c], x[a], v);
  cw_sub(x[c], x[b], w);
  cw_cross(u, v, n);
  double longest = fmax(cw_dot(u, u), fmax(cw_dot(v, v), cw_dot(w, w)));
  return cw_norm(n) > FLATTEST * longest;
}

// Turns side k of t and sets the triangles at the four vertices.
static void turn_side(Wall *wall, int32_t t, int k, int32_t u) {
  cw_flip(&wall->mesh, t, k, u);
  for (int i = 0; i < 3; i++) {
    wall->around[wall->mesh.triangle[t][i]] = t;
    wall->around[wall->mesh.triangle[u][i]] = u;
  }
}

// A triangle as it was.
typedef struct {
  int32_t t, corner[3], near[3];
} Kept;

static void keep(const CwFlipMesh *mesh, Kept *kept) {
  if (kept->t < 0) return;
  memcpy(kept->corner, mesh->triangle[kept->t], sizeof kept->corner);
  memcpy(kept->near, mesh->near[kept->t], sizeof kept->near);
}

static void put_back(const CwFlipMesh *mesh, const Kept *kept) {
  if (kept->t < 0) return;
  memcpy(mesh->triangle[kept->t], kept->corner, sizeof kept->corner);
  memcpy(mesh->near[kept->t], kept->near, sizeof kept->near);
}

// Flips the side k of t where that opens its vertices.
static int try_side(Wall *wall, const int64_t *group, int32_t t, int k) {
  const CwFlipMesh *mesh = &wall->mesh;
  int32_t u = mesh->near[t][k];
  if (u < 0 || group[t] != group[u]) return 0;
  int32_t a = mesh->triangle[t][k], b = mesh->triangle[t][(k + 1) % 3], c = mesh->triangle[t][(k + 2) % 3];
  int32_t d = mesh->triangle[u][(cw_flip_corner(mesh, u, b) + 2) % 3];
  const int32_t corner[4] = {a, b, c, d};
  if (c == d || cw_flip_joined(mesh, t, c, d) || !is_fair(wall->x, c, d, b) || !is_fair(wall->x, d, c, a)) return 0;
  int32_t other[2] = {mesh->near[t][(k + 2) % 3], mesh->near[u][(cw_flip_corner(mesh, u, b) + 2) % 3]};
  int32_t around[4];
  Kept kept[4] = {{.t = t}, {.t = u}, {.t = other[0]}, {.t = other[1]}};
  double before = least_openness(wall, corner);
  for (int i = 0; i < 4; i++) {
    keep(mesh, &kept[i]);
    around[i] = wall->around[corner[i]];
  }
  turn_side(wall, t, k, u);
  if (least_openness(wall, corner) > before + cw_policy.least_gain) {
    for (int i = 0; i < 4; i++) wall->stale[corner[i]] = 1;
    return 1;
  }
  for (int i = 0; i < 4; i++) {
    put_back(mesh, &kept[i]);
    wall->around[corner[i]] = around[i];
  }
  return 0;
}

CwStatus cw_wall_unfold(const CwContext *context, int32_t point_count, const double (*x)[3], int32_t triangle_count,
                        CwFlipMesh *mesh, const int64_t *group, int32_t *flips, int32_t *folded) {
  CwStatus status = CW_OK;
  Wall wall = {.x = x, .mesh = *mesh};
  *flips = *folded = 0;
  CW_NEW(wall.around, point_count);
  CW_NEW(wall.open, point_count);
  CW_NEW(wall.stale, point_count);
  for (int32_t v = 0; v < point_count; v++) wall.around[v] = -1;
  for (int32_t t = 0; t < triangle_count; t++)
    for (int k = 0; group[t] >= 0 && k < 3; k++) wall.around[mesh->triangle[t][k]] = t;
  CW_TRY(cw_parallel_for(context, "layers: folds", point_count, sizeof *wall.open, judge_vertex, &wall, wall.open));
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    int32_t made = 0;
    *folded = 0;
    for (int32_t v = 0; v < point_count; v++) {
      if (wall.stale[v]) wall.open[v] = openness(&wall, v);
      wall.stale[v] = 0;
      if (wall.open[v] >= cw_policy.column_least_cosine) continue;
      ++*folded;
      int turned = 0;
      for (int way = 0; way < 2 && !turned; way++) {
        int32_t first = wall.around[v], t = first;
        do { // the sides at v and the one across from it
          for (int k = 0; k < 3 && !turned; k++) turned = try_side(&wall, group, t, k);
          if (turned) break;
          int k = cw_flip_corner(&wall.mesh, t, v);
          t = wall.mesh.near[t][way ? k : (k + 2) % 3];
        } while (t >= 0 && t != first);
        if (t >= 0) break;
      }
      made += turned;
    }
    *flips += made;
    if (made == 0) break;
  }
done:
  free(wall.around);
  free(wall.open);
  free(wall.stale);
  return status;
}
