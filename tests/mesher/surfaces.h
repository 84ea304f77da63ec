// SPDX-License-Identifier: AGPL-3.0-or-later
// Small generators of test surfaces: structured grids, welded where they meet.
#pragma once

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define MM 1e-3

typedef struct {
  int32_t point_count, triangle_count;
  double (*x)[3];
  int32_t (*triangle)[3];
} Surface;

typedef void (*SurfaceMap)(const void *context, double u, double v, double x[3]);

static inline int32_t surface_point(Surface *s, const double x[3]) {
  s->x = realloc(s->x, (size_t)(s->point_count + 1) * sizeof *s->x);
  memcpy(s->x[s->point_count], x, sizeof *s->x);
  return s->point_count++;
}

static inline void surface_triangle(Surface *s, int32_t a, int32_t b, int32_t c) {
  s->triangle = realloc(s->triangle, (size_t)(s->triangle_count + 1) * sizeof *s->triangle);
  int32_t *t = s->triangle[s->triangle_count++];
  t[0] = a, t[1] = b, t[2] = c;
}

// Grid over the unit square; the normal is xu x xv, or the other way with `flip`. Diagonals alternate.
static inline void surface_grid(Surface *s, SurfaceMap map, const void *context, int nu, int nv, int flip) {
  int32_t first = s->point_count;
  for (int i = 0; i <= nu; i++)
    for (int j = 0; j <= nv; j++) {
      double x[3];
      map(context, (double)i / nu, (double)j / nv, x);
      surface_point(s, x);
    }
  for (int i = 0; i < nu; i++)
    for (int j = 0; j < nv; j++) {
      int32_t a = first + i * (nv + 1) + j, b = a + nv + 1, c = b + 1, d = a + 1;
      int32_t t[2][3] = {{a, b, c}, {a, c, d}};
      if ((i + j) % 2) {
        int32_t o[2][3] = {{a, b, d}, {b, c, d}};
        memcpy(t, o, sizeof t);
      }
      for (int k = 0; k < 2; k++) surface_triangle(s, t[k][0], t[k][flip ? 2 : 1], t[k][flip ? 1 : 2]);
    }
}

static inline void surface_bilinear(const void *context, double u, double v, double x[3]) {
  const double(*p)[3] = context;
  for (int k = 0; k < 3; k++)
    x[k] = (1 - u) * (1 - v) * p[0][k] + u * (1 - v) * p[1][k] + u * v * p[2][k] + (1 - u) * v * p[3][k];
}

// Four corners in order; the normal follows the right hand.
static inline void surface_quad(Surface *s, const double p[4][3], int nu, int nv) {
  surface_grid(s, surface_bilinear, p, nu, nv, 0);
}

// Plate of `width` (along x) by 10 mm at height z, in squares of side h; its normal points up, or down with `flip`.
static inline void surface_plate(Surface *s, double width, double z, double h, int flip) {
  const double p[4][3] = {{0, 0, z}, {width, 0, z}, {width, 0.01, z}, {0, 0.01, z}};
  surface_grid(s, surface_bilinear, p, (int)lround(width / h), (int)lround(0.01 / h), flip);
}

static inline void surface_pipe_point(const void *context, double u, double v, double x[3]) {
  const double *p = context; // radius, length
  x[0] = p[0] * cos(2 * M_PI * u);
  x[1] = p[1] * v;
  x[2] = p[0] * sin(2 * M_PI * u);
}

// Pipe of a radius and a length around the y axis, from y = 0 on, normals outward.
static inline void surface_pipe(Surface *s, double radius, double length, int around, int along) {
  surface_grid(s, surface_pipe_point, (const double[2]){radius, length}, around, along, 1);
}

// Box from `low` to `high`, normals outward, or inward with `flip`; sides: bits 0..5 = x-, x+, y-, y+, z-,
// z+.
static inline void surface_box(Surface *s, const double low[3], const double high[3], double h, int sides, int flip) {
  for (int side = 0; side < 6; side++) {
    if (!(sides >> side & 1)) continue;
    int axis = side / 2, a = (axis + 1) % 3, b = (axis + 2) % 3, upper = side % 2;
    double p[4][3];
    for (int i = 0; i < 4; i++) {
      p[i][axis] = upper ? high[axis] : low[axis];
      p[i][a] = i == 1 || i == 2 ? high[a] : low[a];
      p[i][b] = i >= 2 ? high[b] : low[b];
    }
    surface_grid(s, surface_bilinear, p, (int)lround((high[a] - low[a]) / h), (int)lround((high[b] - low[b]) / h),
                 upper ? flip : !flip);
  }
}

// Wall over a polygon of the (x,z) plane, extruded along y from 0 to `depth`; fluid to the left of the polygon's edges
// when looking along +y from... see `flip`: without it the outward normal is edge x y.
static inline void surface_extrude(Surface *s, int count, const double (*p)[2], int closed, double depth, double h,
                                   int flip) {
  for (int i = 0; i < count - !closed; i++) {
    const double *a = p[i], *b = p[(i + 1) % count];
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    double q[4][3] = {{a[0], 0, a[1]}, {b[0], 0, b[1]}, {b[0], depth, b[1]}, {a[0], depth, a[1]}};
    int n = (int)ceil(length / h - 1e-9), m = (int)ceil(depth / h - 1e-9);
    surface_grid(s, surface_bilinear, q, n, m, flip);
  }
}

// Both ends of what is extruded: a rectangle of the (x,z) plane at y = 0 and at y = depth, normals away from each
// other.
static inline void surface_ends(Surface *s, double x0, double z0, double x1, double z1, double depth) {
  const double front[4][3] = {{x0, 0, z0}, {x1, 0, z0}, {x1, 0, z1}, {x0, 0, z1}};
  const double back[4][3] = {{x0, depth, z0}, {x0, depth, z1}, {x1, depth, z1}, {x1, depth, z0}};
  surface_quad(s, front, 1, 1);
  surface_quad(s, back, 1, 1);
}

typedef struct {
  int64_t key[3];
  int32_t v;
} SurfaceKey;

static inline int surface_key_order(const void *a, const void *b) {
  const SurfaceKey *p = a, *q = b;
  for (int k = 0; k < 3; k++)
    if (p->key[k] != q->key[k]) return p->key[k] < q->key[k] ? -1 : 1;
  return (p->v > q->v) - (p->v < q->v);
}

// Makes one point of all within 1e-8 m; drops triangles that lose their area by it.
static inline void surface_weld(Surface *s) {
  SurfaceKey *key = malloc((s->point_count + 1) * sizeof *key);
  int32_t *to = malloc((s->point_count + 1) * sizeof *to);
  for (int32_t v = 0; v < s->point_count; v++) {
    for (int k = 0; k < 3; k++) key[v].key[k] = llround(s->x[v][k] / 1e-8 + 0.3171);
    key[v].v = v;
  }
  qsort(key, s->point_count, sizeof *key, surface_key_order);
  for (int32_t i = 0; i < s->point_count; i++) {
    int same = i > 0 && !memcmp(key[i].key, key[i - 1].key, sizeof key[i].key);
    to[key[i].v] = same ? to[key[i - 1].v] : key[i].v;
  }
  int32_t count = 0;
  for (int32_t v = 0; v < s->point_count; v++)
    if (to[v] == v) {
      memmove(s->x[count], s->x[v], sizeof *s->x);
      to[v] = count++;
    } else {
      to[v] = to[to[v]]; // an earlier point, renumbered already
    }
  s->point_count = count;
  int32_t kept = 0;
  for (int32_t f = 0; f < s->triangle_count; f++) {
    int32_t a = to[s->triangle[f][0]], b = to[s->triangle[f][1]], c = to[s->triangle[f][2]];
    if (a == b || b == c || c == a) continue;
    s->triangle[kept][0] = a, s->triangle[kept][1] = b, s->triangle[kept][2] = c;
    kept++;
  }
  s->triangle_count = kept;
  free(key);
  free(to);
}

static inline void surface_free(Surface *s) {
  free(s->x);
  free(s->triangle);
  memset(s, 0, sizeof *s);
}
