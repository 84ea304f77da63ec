// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hard_polyhedra.h"

#include "surface_shapes.h"

static const double PI = 3.141592653589793;

// A prism of n sides of which the upper polygon is turned against their diagonals, so that they bend inwards.
static void twisted_prism(Surface *s, int n, double degrees, double height) {
  for (int k = 0; k < 2 * n; k++) {
    double a = 2.0 * PI * (k % n) / n - (k < n ? 0.0 : degrees * PI / 180.0);
    shape_point(s, 0.01 * cos(a), 0.01 * sin(a), k < n ? 0.0 : height);
  }
  for (int k = 0; k < n; k++) {
    int32_t a = k, b = (k + 1) % n;
    surface_facing(s, a, b, a + n, 1);
    surface_facing(s, b, b + n, a + n, 1);
    if (k > 0 && k < n - 1) {
      surface_facing(s, 0, b, a, 1);
      surface_facing(s, n, n + a, n + b, 1);
    }
  }
}

static void schoenhardt(Surface *s, double *size) {
  twisted_prism(s, 3, 30, *size = 0.01);
}

static void schoenhardt_nearly_closed(Surface *s, double *size) {
  twisted_prism(s, 3, 55, *size = 0.01);
}

static void schoenhardt_flat(Surface *s, double *size) {
  twisted_prism(s, 3, 40, 0.0005);
  *size = 0.01;
}

static void twisted_prism_of_8_sides(Surface *s, double *size) {
  twisted_prism(s, 8, 40, 0.02);
  *size = 0.01;
}

static void twisted_prism_of_30_sides(Surface *s, double *size) {
  twisted_prism(s, 30, 100, 0.02);
  *size = 0.01;
}

static void column_of_schoenhardts(Surface *s, double *size) {
  const double p[3][2] = {{0.01, 0}, {-0.005, 0.00866}, {-0.005, -0.00866}};
  shape_extrude(s, 3, p, 1.0, 0.08, 8, 8 * 35 * PI / 180.0,
                1); // against the diagonals: every side bends inwards
  *size = 0.01;
}

static void schoenhardt_void(Surface *s, double *size) {
  twisted_prism(s, 3, 30, *size = 0.01);
  for (int32_t t = 0; t < s->triangle_count; t++) {
    int32_t swap = s->triangle[t][0];
    s->triangle[t][0] = s->triangle[t][1];
    s->triangle[t][1] = swap;
  }
  shape_box(s, -0.011, -0.011, -0.001, 0.011, 0.011, 0.011, 1, 1, 1, 1);
}

// Notches from below along y and from above along x, whose ridges nearly meet on the saddle z = x y
// (B. Chazelle, SIAM J. Comput. 13, 1984).
static void chazelle(Surface *s, double *size) {
  enum { N = 4 };
  const double width = 0.1, near = 0.02, m = N + 1, deep = -6.0, high = m * m + 6.0;
  int32_t low[2][3 * N + 2], top[2][3 * N + 2];
  for (int end = 0; end < 2; end++) {
    for (int k = 0; k < 3 * N + 2; k++) {
      int i = (k + 2) / 3, ridge = k > 0 && k < 3 * N + 1 && k % 3 == 2;
      double across = k == 0 ? 0 : k == 3 * N + 1 ? m : i + (k % 3 == 1 ? -width : k % 3 == 0 ? width : 0);
      if (k > 0 && k < 3 * N + 1 && k % 3 == 0) across = k / 3 + width;
      if (ridge) across = (k + 1) / 3;
      double along = end ? m : 0, z = across * along;
      low[end][k] = shape_point(s, across, along, ridge ? z - near : deep);
      top[end][k] = shape_point(s, along, across, ridge ? z + near : high);
    }
  }
  for (int k = 0; k < 3 * N + 1; k++) {
    surface_facing(s, low[0][k], low[1][k], low[1][k + 1], 1);
    surface_facing(s, low[0][k], low[1][k + 1], low[0][k + 1], 1);
    surface_facing(s, top[0][k], top[1][k], top[1][k + 1], 1);
    surface_facing(s, top[0][k], top[1][k + 1], top[0][k + 1], 1);
  }
  // Walls: two with the zigzag below and a straight edge above, two the other way.
  for (int end = 0; end < 2; end++) {
    double p[3 * N + 4][2];
    int triangle[3 * N + 4][3];
    int32_t at[2][3 * N + 4];
    int n = 3 * N + 2;
    for (int k = 0; k < n; k++) {
      p[k][0] = s->x[low[end][k]][0];
      p[k][1] = s->x[low[end][k]][2];
      at[0][k] = low[end][k];
    }
    at[0][n] = top[1][end ? n - 1 : 0];
    at[0][n + 1] = top[0][end ? n - 1 : 0];
    for (int k = n; k < n + 2; k++) {
      p[k][0] = s->x[at[0][k]][0];
      p[k][1] = s->x[at[0][k]][2];
    }
    int count = shape_ears(n + 2, (const double(*)[2])p, triangle);
    for (int t = 0; t < count; t++)
      surface_facing(s, at[0][triangle[t][0]], at[0][triangle[t][1]], at[0][triangle[t][2]], end == 0);
    for (int k = 0; k < n; k++) { // turned over, to be counter-clockwise too
      at[1][k] = top[end][n - 1 - k];
      p[k][0] = s->x[at[1][k]][1];
      p[k][1] = s->x[at[1][k]][2];
    }
    at[1][n] = low[0][end ? n - 1 : 0];
    at[1][n + 1] = low[1][end ? n - 1 : 0];
    for (int k = n; k < n + 2; k++) {
      p[k][0] = s->x[at[1][k]][1];
      p[k][1] = s->x[at[1][k]][2];
    }
    count = shape_ears(n + 2, (const double(*)[2])p, triangle);
    for (int t = 0; t < count; t++)
      surface_facing(s, at[1][triangle[t][0]], at[1][triangle[t][1]], at[1][triangle[t][2]], end == 1);
  }
  shape_scale(s, 0.01, 0.01, 0.002);
  *size = 0.01;
}

static void spiral(Surface *s, double *size) {
  double p[122][2];
  for (int k = 0; k < 122; k++) {
    int i = k < 61 ? k : 121 - k;
    double a = 6.0 * PI * i / 60.0, r = 0.005 + 0.0015 * a + (k < 61 ? 0.004 : 0.0);
    p[k][0] = r * cos(a), p[k][1] = r * sin(a);
  }
  shape_extrude(s, 122, (const double(*)[2])p, 0.006, 0.02, 4, 0.0, 1);
  *size = 0.005;
}

static void re_entrant(Surface *s, double *size) {
  const double p[6][2] = {{0, 0}, {0.04, 0}, {0.04, 0.01}, {0.01, 0.01}, {0.01, 0.04}, {0, 0.04}};
  shape_extrude(s, 6, p, *size = 0.005, 0.02, 4, 0.0, 1);
}

static void coarse_re_entrant(Surface *s, double *size) {
  const double p[6][2] = {{0, 0}, {0.04, 0}, {0.04, 0.001}, {0.001, 0.001}, {0.001, 0.04}, {0, 0.04}};
  shape_extrude(s, 6, p, 0.04, 0.04, 1, 0.0, 1);
  *size = 0.02;
}

static void comb(Surface *s, double *size) {
  shape_comb(s, 8, 0.5, *size = 0.004, 0.012, 3, 0.0);
}

static void comb_of_thin_teeth(Surface *s, double *size) {
  shape_comb(s, 8, 0.05, *size = 0.004, 0.012, 3, 0.0);
}

static void comb_of_thin_slots(Surface *s, double *size) {
  shape_comb(s, 8, 0.97, *size = 0.004, 0.012, 3, 0.0);
}

static void comb_without_points(Surface *s, double *size) {
  shape_comb(s, 8, 0.9, 1.0, 0.03, 1, 0.0);
  *size = 0.01;
}

static void star(Surface *s, double *size) {
  shape_star(s, 5, 0.008, *size = 0.004, 0.01, 3, 0.0);
}

static void twisted_star(Surface *s, double *size) {
  shape_star(s, 7, 0.004, *size = 0.004, 0.04, 10, 2.0);
}

static void star_twisted_without_points(Surface *s, double *size) {
  shape_star(s, 6, 0.006, 1.0, 0.03, 3, -1.2);
  *size = 0.01;
}

static void sharp_star(Surface *s, double *size) {
  shape_star(s, 24, 0.004, 1.0, 0.02, 2, 0.0);
  *size = 0.004;
}

const HardBoundary hard_polyhedra[] = {
    HARD(schoenhardt),
    HARD(schoenhardt_nearly_closed),
    HARD(schoenhardt_flat),
    HARD(twisted_prism_of_8_sides),
    HARD(twisted_prism_of_30_sides),
    HARD(column_of_schoenhardts),
    HARD(schoenhardt_void),
    HARD(chazelle),
    HARD(spiral),
    HARD(re_entrant),
    HARD(coarse_re_entrant),
    HARD(comb),
    HARD(comb_of_thin_teeth),
    HARD(comb_of_thin_slots),
    HARD(comb_without_points),
    HARD(star),
    HARD(twisted_star),
    HARD(star_twisted_without_points),
    HARD(sharp_star),
};
const int hard_polyhedra_count = sizeof hard_polyhedra / sizeof *hard_polyhedra;
