// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/front_flip.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/vec.h"

enum { SWEEPS = 12 };
static const double GAIN = 1.1;          // least factor by which a flip raises the least angle of the front
static const double FLAT = 0.9;          // cosine between the normals of a pair that may be turned
static const double WALL_SHARE = 0.6;    // of its least angle the wall keeps
static const double FAIR_ANGLE = 0.35;   // rad: a wall triangle with angles above it is fair in any case
static const double VALID_PRISM = 0.02;  // scaled Jacobian of a prism, least

typedef struct {
  int32_t a, b, triangle; // a < b
} Side;

static int compare_sides(const void *p, const void *q) {
  const Side *x = p, *y = q;
  if (x->a != y->a) return x->a < y->a ? -1 : 1;
  if (x->b != y->b) return x->b < y->b ? -1 : 1;
  return (x->triangle > y->triangle) - (x->triangle < y->triangle);
}

static double least_angle(const double (*x)[3], int32_t a, int32_t b, int32_t c) {
  const int32_t corner[3] = {a, b, c};
  double least = M_PI;
  for (int k = 0; k < 3; k++) {
    double u[3], v[3], n[3];
    cw_sub(x[corner[(k + 1) % 3]], x[corner[k]], u);
    cw_sub(x[corner[(k + 2) % 3]], x[corner[k]], v);
    cw_cross(u, v, n);
    least = fmin(least, atan2(cw_norm(n), cw_dot(u, v)));
  }
  return least;
}

static void unit_normal(const double (*x)[3], int32_t a, int32_t b, int32_t c, double normal[3]) {
  double u[3], v[3];
  cw_sub(x[b], x[a], u);
  cw_sub(x[c], x[a], v);
  cw_cross(u, v, normal);
  cw_unit(normal);
}

// Least scaled Jacobian over the six corners of the prism between wall and front; the fluid lies against the normal.
static double prism_quality(const double (*wall)[3], const double (*front)[3], int32_t a, int32_t b, int32_t c) {
  const int32_t corner[3] = {a, b, c};
  double least = 1;
  for (int level = 0; level < 2; level++) {
    const double(*x)[3] = level ? front : wall;
    for (int k = 0; k < 3; k++) {
      double u[3], v[3], n[3], column[3];
      cw_sub(x[corner[(k + 1) % 3]], x[corner[k]], u);
      cw_sub(x[corner[(k + 2) % 3]], x[corner[k]], v);
      cw_sub(wall[corner[k]], front[corner[k]], column);
      cw_cross(u, v, n);
      cw_unit(u);
      cw_unit(v);
      cw_unit(column);
      cw_cross(u, v, n);
      least = fmin(least, cw_dot(n, column));
    }
  }
  return least;
}

static int flat_pair(const double (*x)[3], const int32_t p[3], const int32_t q[3]) {
  double n[3], m[3];
  unit_normal(x, p[0], p[1], p[2], n);
  unit_normal(x, q[0], q[1], q[2], m);
  return cw_dot(n, m) > FLAT;
}

// Whether the edge a-b between c (left) and d is better as c-d.
static int flip_helps(const double (*wall)[3], const double (*front)[3], int32_t a, int32_t b, int32_t c, int32_t d) {
  double before = fmin(least_angle(front, a, b, c), least_angle(front, b, a, d));
  double after = fmin(least_angle(front, c, d, b), least_angle(front, d, c, a));
  if (after < GAIN * before) return 0;
  double wall_before = fmin(least_angle(wall, a, b, c), least_angle(wall, b, a, d));
  double wall_after = fmin(least_angle(wall, c, d, b), least_angle(wall, d, c, a));
  if (wall_after < FAIR_ANGLE && wall_after < WALL_SHARE * wall_before) return 0;
  const int32_t old[2][3] = {{a, b, c}, {b, a, d}}, new[2][3] = {{c, d, b}, {d, c, a}};
  if (!flat_pair(front, old[0], old[1]) || !flat_pair(front, new[0], new[1])) return 0;
  if (!flat_pair(wall, old[0], old[1]) || !flat_pair(wall, new[0], new[1])) return 0;
  for (int k = 0; k < 2; k++) {
    if (!flat_pair(front, old[0], new[k]) || !flat_pair(wall, old[0], new[k])) return 0;
    if (prism_quality(wall, front, new[k][0], new[k][1], new[k][2]) < VALID_PRISM) return 0;
  }
  return 1;
}

// The corner across the side a-b, and whether the triangle runs from a to b.
static int32_t opposite(const int32_t corner[3], int32_t a, int32_t b, int *along) {
  for (int k = 0; k < 3; k++) {
    int32_t p = corner[k], q = corner[(k + 1) % 3];
    if ((p == a && q == b) || (p == b && q == a)) {
      *along = p == a;
      return corner[(k + 2) % 3];
    }
  }
  return -1;
}

static int edge_exists(const Side *side, int32_t count, int32_t a, int32_t b) {
  int32_t low = 0, high = count;
  if (a > b) {
    int32_t swap = a;
    a = b;
    b = swap;
  }
  while (low < high) {
    int32_t middle = (low + high) / 2;
    if (side[middle].a < a || (side[middle].a == a && side[middle].b < b)) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low < count && side[low].a == a && side[low].b == b;
}

CwStatus cw_front_flip(int32_t point_count, const double (*wall)[3], const double (*front)[3], int32_t triangle_count,
                       int32_t (*triangle)[3], const int64_t *group, int32_t *flips) {
  CwStatus status = CW_OK;
  Side *side = NULL;
  uint8_t *touched = NULL;
  int32_t sides = 3 * triangle_count;
  *flips = 0;
  CW_NEW(side, sides);
  CW_NEW(touched, point_count);
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    int32_t made = 0;
    for (int32_t t = 0; t < triangle_count; t++) {
      for (int k = 0; k < 3; k++) {
        int32_t a = triangle[t][k], b = triangle[t][(k + 1) % 3];
        side[3 * t + k] = a < b ? (Side){a, b, t} : (Side){b, a, t};
      }
    }
    qsort(side, (size_t)sides, sizeof *side, compare_sides);
    for (int32_t i = 0; i < point_count; i++) touched[i] = 0;
    for (int32_t s = 0; s + 1 < sides; s++) {
      int32_t a = side[s].a, b = side[s].b, t = side[s].triangle, u = side[s + 1].triangle;
      int along, against;
      if (side[s + 1].a != a || side[s + 1].b != b || group[t] != group[u]) continue;
      int32_t c = opposite(triangle[t], a, b, &along), d = opposite(triangle[u], a, b, &against);
      // One flip about a point in a sweep: the sorted sides are those of its start.
      if (c < 0 || d < 0 || along == against || touched[a] || touched[b] || touched[c] || touched[d]) continue;
      if (!along) { // make c lie left of a -> b
        int32_t swap = t;
        t = u;
        u = swap;
        swap = c;
        c = d;
        d = swap;
      }
      if (edge_exists(side, sides, c, d) || !flip_helps(wall, front, a, b, c, d)) continue;
      const int32_t first[3] = {c, d, b}, second[3] = {d, c, a};
      for (int k = 0; k < 3; k++) triangle[t][k] = first[k], triangle[u][k] = second[k];
      touched[a] = touched[b] = touched[c] = touched[d] = 1;
      made++;
    }
    *flips += made;
    if (made == 0) break;
  }
done:
  free(side);
  free(touched);
  return status;
}
