// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hard_boundaries.h"

#include "surface_shapes.h"

static const double PI = 3.141592653589793;

static void straight_curve(const void *context, double u, double x[3], double *radius) {
  const double *p = context; // length, radius at the ends and in the middle
  x[0] = x[1] = 0.0;
  x[2] = p[0] * u;
  *radius = p[2] + (p[1] - p[2]) * fabs(2.0 * u - 1.0);
}

static void helix_curve(const void *context, double u, double x[3], double *radius) {
  const double *p = context; // turns, great radius, pitch, small radius
  x[0] = p[1] * cos(2.0 * PI * p[0] * u);
  x[1] = p[1] * sin(2.0 * PI * p[0] * u);
  x[2] = p[2] * p[0] * u;
  *radius = p[3];
}

static void knot_curve(const void *context, double u, double x[3], double *radius) {
  double a = 2.0 * PI * u;
  x[0] = 0.01 * (sin(a) + 2.0 * sin(2.0 * a));
  x[1] = 0.01 * (cos(a) - 2.0 * cos(2.0 * a));
  x[2] = -0.01 * sin(3.0 * a);
  *radius = *(const double *)context;
}

static void wedge(Surface *s, double degrees, double edge) {
  double a = degrees * PI / 180.0, p[3][2] = {{0, 0}, {0.04, 0}, {0.04 * cos(a), 0.04 * sin(a)}};
  shape_extrude(s, 3, (const double(*)[2])p, edge, 0.03, (int)ceil(0.03 / edge), 0.0, 1);
}

static void cube(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 8, 8, 8, 1);
  *size = 0.005;
}

static void cube_of_twelve_triangles(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 1, 1, 1, 1);
  *size = 0.04;
}

static void turned_cube_with_turned_diagonals(Surface *s, double *size) {
  cube(s, size);
  shape_turn_diagonals(s, 3, 3);
  shape_turn(s, 0.7, 0.4);
}

static void fine_surface_coarse_inside(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 12, 12, 12, 1);
  *size = 0.02;
}

static void coarse_surface_fine_inside(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 2, 2, 2, 1);
  *size = 0.004;
}

static void cylinder(Surface *s, double *size) {
  shape_tube(s, straight_curve, (double[3]){0.04, 0.01, 0.01}, 24, 16, 0, 0.0, 1);
  *size = 0.0026;
}

static void cylinder_of_long_quads(Surface *s, double *size) {
  shape_tube(s, straight_curve, (double[3]){0.08, 0.01, 0.01}, 48, 3, 0, 0.0, 1);
  *size = 0.003;
}

static void cylinder_of_flat_quads(Surface *s, double *size) {
  shape_tube(s, straight_curve, (double[3]){0.02, 0.01, 0.01}, 6, 60, 0, 0.0, 1);
  *size = 0.003;
}

static void twisted_cylinder(Surface *s, double *size) {
  shape_tube(s, straight_curve, (double[3]){0.04, 0.01, 0.01}, 12, 16, 0, 0.9, 1);
  *size = 0.004;
}

static void hourglass(Surface *s, double *size) {
  shape_tube(s, straight_curve, (double[3]){0.04, 0.01, 0.0002}, 16, 40, 0, 0.0, 1);
  *size = 0.002;
}

static void thin_gap(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 8, 8, 8, 1);
  shape_box(s, 0.01, 0.01, 0.0001, 0.03, 0.03, 0.03, 4, 4, 4, 0);
  *size = 0.005;
}

static void thin_gap_all_round(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 6, 6, 6, 1);
  shape_box(s, 0.0004, 0.0004, 0.0004, 0.0396, 0.0396, 0.0396, 7, 7, 7, 0);
  *size = 0.006;
}

static void nearly_touching_spheres(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.02, 3, 1);
  shape_ball(s, 0.04001, 0, 0, 0.02, 2, 1);
  *size = 0.004;
}

static void nearly_touching_voids(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.05, 3, 1);
  shape_ball(s, -0.0151, 0, 0, 0.015, 2, 0);
  shape_ball(s, 0.0151, 0.0003, 0, 0.015, 2, 0);
  *size = 0.008;
}

static void void_near_the_wall(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.05, 3, 1);
  shape_ball(s, 0, 0, 0.0095, 0.04, 3, 0);
  *size = 0.008;
}

static void wedge_30(Surface *s, double *size) {
  wedge(s, 30, *size = 0.004);
}

static void wedge_15(Surface *s, double *size) {
  wedge(s, 15, *size = 0.004);
}

static void wedge_10(Surface *s, double *size) {
  wedge(s, 10, *size = 0.004);
}

static void wedge_5(Surface *s, double *size) {
  wedge(s, 5, *size = 0.004);
}

static void wedge_1(Surface *s, double *size) {
  wedge(s, 1, *size = 0.004);
}

static void void_wedge_5(Surface *s, double *size) { // a cut as sharp into the body
  const double a = 5 * PI / 180.0;
  double q[7][2] = {
      {0, 0},   {0.04 * cos(a), 0.04 * sin(a)}, {0.04, 0.02}, {-0.02, 0.02}, {-0.02, -0.02}, {0.04, -0.02},
      {0.04, 0}};
  shape_extrude(s, 7, (const double(*)[2])q, *size = 0.005, 0.02, 4, 0.0, 1);
}

static void needle(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.001, 2, 1);
  shape_scale(s, 1, 1, 50);
  *size = 0.001;
}

static void needle_of_a_cone(Surface *s, double *size) {
  int n = 20;
  int32_t tip = shape_point(s, 0, 0, 0.1), foot = shape_point(s, 0, 0, 0), first = s->point_count;
  for (int k = 0; k < n; k++)
    shape_point(s, 0.002 * cos(2 * PI * k / n), 0.002 * sin(2 * PI * k / n), 0);
  for (int k = 0; k < n; k++) {
    surface_triangle(s, first + k, first + (k + 1) % n, tip, 1);
    surface_triangle(s, first + (k + 1) % n, first + k, foot, 1);
  }
  *size = 0.001;
}

static void spikes(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.01, 2, 1);
  for (int32_t p = 0; p < s->point_count; p += 5) {
    for (int i = 0; i < 3; i++)
      s->x[p][i] *= 5.0;
  }
  *size = 0.003;
}

static void dents(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.01, 2, 1);
  for (int32_t p = 0; p < s->point_count; p += 5) {
    for (int i = 0; i < 3; i++)
      s->x[p][i] *= 0.05;
  }
  *size = 0.003;
}

static void one_void(Surface *s, double *size) {
  shape_box(s, -0.02, -0.02, -0.02, 0.02, 0.02, 0.02, 6, 6, 6, 1);
  shape_ball(s, 0.001, 0, 0, 0.012, 2, 0);
  *size = 0.006;
}

static void many_voids(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 6, 6, 6, 1);
  for (int k = 0; k < 27; k++)
    shape_ball(s, 0.01 + 0.01 * (k % 3), 0.01 + 0.01 * (k / 3 % 3), 0.01 + 0.01 * (k / 9), 0.0045, 1, 0);
  *size = 0.006;
}

static void five_shells(Surface *s, double *size) {
  for (int k = 0; k < 5; k++)
    shape_ball(s, 0.0004 * k, 0, 0, 0.05 - 0.008 * k, k < 3 ? 3 : 2, k % 2 == 0);
  *size = 0.01;
}

static void one_torus(Surface *s, double *size) {
  shape_torus(s, 0, 0, 0, 0.03, 0.008, 0.0, 12, 40, 1);
  *size = 0.004;
}

static void thin_torus(Surface *s, double *size) {
  shape_torus(s, 0, 0, 0, 0.03, 0.001, 0.3, 5, 60, 1);
  *size = 0.002;
}

static void linked_torus_voids(Surface *s, double *size) {
  shape_box(s, -0.05, -0.05, -0.05, 0.08, 0.05, 0.05, 10, 8, 8, 1);
  shape_torus(s, 0, 0, 0, 0.03, 0.008, 0.0, 10, 30, 0);
  shape_torus(s, 0.03, 0, 0, 0.03, 0.008, PI / 2, 10, 30, 0);
  *size = 0.012;
}

static void linked_tori(Surface *s, double *size) {
  shape_torus(s, 0, 0, 0, 0.03, 0.008, 0.0, 10, 30, 1);
  shape_torus(s, 0.03, 0, 0, 0.03, 0.008, PI / 2, 10, 30, 1);
  *size = 0.005;
}

static void torus_in_a_torus(Surface *s, double *size) {
  shape_torus(s, 0, 0, 0, 0.03, 0.008, 0.0, 12, 36, 1);
  shape_torus(s, 0, 0, 0, 0.03, 0.006, 0.0, 10, 30, 0);
  *size = 0.004;
}

static void slab(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.0001, 16, 16, 1, 1);
  *size = 0.0025;
}

static void slab_of_turned_diagonals(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.0005, 16, 16, 1, 1);
  shape_turn_diagonals(s, 9, 2);
  *size = 0.0025;
}

static void foil(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04e-4, 12, 12, 1, 1);
  *size = 0.003;
}

static void bent_slab(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 1, 1, 1, 40, 8, 1, 1);
  for (int32_t p = 0; p < s->point_count; p++) {
    double a = 5.0 * s->x[p][0], r = 0.03 + 0.0002 * s->x[p][2], y = s->x[p][1];
    s->x[p][0] = r * sin(a), s->x[p][1] = 0.02 * y,
    s->x[p][2] = r * cos(a); // (along, y, out) stays right-handed
  }
  *size = 0.003;
}

static void sizes_varying_by_50(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 4, 4, 4, 1);
  shape_refine(s, (double[3]){0.04, 0.017, 0.04}, 0.0002, 0.35, 6000);
  *size = 0.01;
}

static void sphere_with_a_fine_spot(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.04, 1, 1);
  shape_refine(s, s->x[7], 0.0003, 0.5, 6000);
  *size = 0.01;
}

static void thin_box_with_a_fine_spot(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.002, 2, 2, 1, 1);
  shape_refine(s, (double[3]){0.013, 0.017, 0.002}, 0.0001, 0.5, 6000);
  *size = 0.01;
}

// A prism of n sides of which the upper polygon is turned, so that the sides bend inwards.
static void twisted_prism(Surface *s, int n, double degrees, double height) {
  for (int k = 0; k < 2 * n; k++) {
    double a = 2.0 * PI * (k % n) / n + (k < n ? 0.0 : degrees * PI / 180.0);
    shape_point(s, 0.01 * cos(a), 0.01 * sin(a), k < n ? 0.0 : height);
  }
  for (int k = 0; k < n; k++) {
    int32_t a = k, b = (k + 1) % n;
    surface_triangle(s, a, b, a + n, 1);
    surface_triangle(s, b, b + n, a + n, 1);
    if (k > 0 && k < n - 1) {
      surface_triangle(s, 0, b, a, 1);
      surface_triangle(s, n, n + a, n + b, 1);
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
  shape_extrude(s, 3, p, 1.0, 0.08, 8, -8 * 35 * PI / 180.0,
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
      if (k > 0 && k < 3 * N + 1 && k % 3 == 0)
        across = k / 3 + width;
      if (ridge)
        across = (k + 1) / 3;
      double along = end ? m : 0, z = across * along;
      low[end][k] = shape_point(s, across, along, ridge ? z - near : deep);
      top[end][k] = shape_point(s, along, across, ridge ? z + near : high);
    }
  }
  for (int k = 0; k < 3 * N + 1; k++) {
    surface_triangle(s, low[0][k], low[1][k], low[1][k + 1], 1);
    surface_triangle(s, low[0][k], low[1][k + 1], low[0][k + 1], 1);
    surface_triangle(s, top[0][k], top[1][k], top[1][k + 1], 1);
    surface_triangle(s, top[0][k], top[1][k + 1], top[0][k + 1], 1);
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
      surface_triangle(s, at[0][triangle[t][0]], at[0][triangle[t][1]], at[0][triangle[t][2]], end == 0);
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
      surface_triangle(s, at[1][triangle[t][0]], at[1][triangle[t][1]], at[1][triangle[t][2]], end == 1);
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

static void helix(Surface *s, double *size) {
  shape_tube(s, helix_curve, (double[4]){3, 0.01, 0.006, 0.0025}, 10, 120, 0, 0.0, 1);
  *size = 0.0016;
}

static void tight_helix(Surface *s, double *size) { // turns nearly touch
  shape_tube(s, helix_curve, (double[4]){4, 0.01, 0.0052, 0.0025}, 8, 120, 0, 0.0, 1);
  *size = 0.002;
}

static void knot_void(Surface *s, double *size) {
  shape_box(s, -0.035, -0.035, -0.02, 0.035, 0.035, 0.02, 8, 8, 5, 1);
  shape_tube(s, knot_curve, (double[1]){0.003}, 8, 90, 1, 0.0, 0);
  *size = 0.008;
}

static void sphere_of_poles(Surface *s, double *size) {
  const int rows = 24, columns = 12;
  int32_t south = shape_point(s, 0, 0, -0.02), north = shape_point(s, 0, 0, 0.02), base = s->point_count;
  for (int c = 1; c < columns; c++) {
    for (int r = 0; r < rows; r++) {
      double a = 2.0 * PI * r / rows, b = PI * c / columns;
      shape_point(s, 0.02 * sin(b) * cos(a), 0.02 * sin(b) * sin(a), -0.02 * cos(b));
    }
  }
  for (int r = 0; r < rows; r++) {
    int q = (r + 1) % rows;
    for (int c = 0; c + 2 < columns; c++) {
      int32_t a = base + c * rows;
      surface_triangle(s, a + r, a + q, a + rows + q, 1);
      surface_triangle(s, a + r, a + rows + q, a + rows + r, 1);
    }
    surface_triangle(s, south, base + q, base + r, 1);
    surface_triangle(s, north, base + (columns - 2) * rows + r, base + (columns - 2) * rows + q, 1);
  }
  *size = 0.004;
}

static void sphere_of_turned_diagonals(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.05, 3, 1);
  shape_turn_diagonals(s, 5, 4);
  *size = 0.007;
}

static void lens(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.02, 3, 1);
  for (int32_t p = 0; p < s->point_count; p++)
    s->x[p][2] *= 0.05;
  *size = 0.003;
}

static void long_triangles(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.09, 0.01, 0.01, 1, 12, 12, 1);
  *size = 0.004;
}

static void long_triangles_both_ways(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.03, 0.03, 0.002, 1, 20, 1, 1);
  shape_turn_diagonals(s, 4, 2);
  *size = 0.01;
}

// Two cubes with an edge in common, and two with a corner.
static void add_touching_box(Surface *s, double x, double y, double z) {
  Surface other = {0};
  shape_box(&other, x, y, z, x + 0.01, y + 0.01, z + 0.01, 2, 2, 2, 1);
  int32_t *number = malloc((size_t)other.point_count * sizeof *number);
  int32_t before = s->point_count;
  for (int32_t p = 0; p < other.point_count; p++) {
    number[p] = -1;
    for (int32_t q = 0; q < before && number[p] < 0; q++) {
      double d = 0.0;
      for (int i = 0; i < 3; i++)
        d += fabs(s->x[q][i] - other.x[p][i]);
      if (d < 1e-9)
        number[p] = q;
    }
    if (number[p] < 0)
      number[p] = shape_point(s, other.x[p][0], other.x[p][1], other.x[p][2]);
  }
  for (int32_t t = 0; t < other.triangle_count; t++)
    surface_triangle(s, number[other.triangle[t][0]], number[other.triangle[t][1]],
                     number[other.triangle[t][2]], 1);
  free(number);
  surface_free(&other);
}

static void boxes_with_a_common_edge(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.01, 0.01, 0.01, 2, 2, 2, 1);
  add_touching_box(s, 0.01, 0.01, 0);
  *size = 0.005;
}

static void boxes_with_a_common_corner(Surface *s, double *size) {
  shape_box(s, 0, 0, 0, 0.01, 0.01, 0.01, 2, 2, 2, 1);
  add_touching_box(s, 0.01, 0.01, 0.01);
  *size = 0.005;
}

static void box_far_from_the_origin(Surface *s, double *size) {
  cube(s, size);
  for (int32_t p = 0; p < s->point_count; p++) {
    for (int i = 0; i < 3; i++)
      s->x[p][i] += 1000.0 * (i + 1);
  }
}

static void warped_box(Surface *s, double *size) {
  uint64_t seed = 12;
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 8, 8, 8, 1);
  for (int32_t p = 0; p < 3 * s->point_count; p++)
    s->x[p / 3][p % 3] += 0.0022 * (draw(&seed) - 0.5);
  *size = 0.005;
}

static const struct {
  const char *name;
  void (*make)(Surface *, double *);
} hard[] = {
#define HARD(name)                                                                                           \
  { #name, name }
    HARD(cube),
    HARD(cube_of_twelve_triangles),
    HARD(turned_cube_with_turned_diagonals),
    HARD(fine_surface_coarse_inside),
    HARD(coarse_surface_fine_inside),
    HARD(cylinder),
    HARD(cylinder_of_long_quads),
    HARD(cylinder_of_flat_quads),
    HARD(twisted_cylinder),
    HARD(hourglass),
    HARD(thin_gap),
    HARD(thin_gap_all_round),
    HARD(nearly_touching_spheres),
    HARD(nearly_touching_voids),
    HARD(void_near_the_wall),
    HARD(wedge_30),
    HARD(wedge_15),
    HARD(wedge_10),
    HARD(wedge_5),
    HARD(wedge_1),
    HARD(void_wedge_5),
    HARD(needle),
    HARD(needle_of_a_cone),
    HARD(spikes),
    HARD(dents),
    HARD(one_void),
    HARD(many_voids),
    HARD(five_shells),
    HARD(one_torus),
    HARD(thin_torus),
    HARD(linked_torus_voids),
    HARD(linked_tori),
    HARD(torus_in_a_torus),
    HARD(slab),
    HARD(slab_of_turned_diagonals),
    HARD(foil),
    HARD(bent_slab),
    HARD(sizes_varying_by_50),
    HARD(sphere_with_a_fine_spot),
    HARD(thin_box_with_a_fine_spot),
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
    HARD(helix),
    HARD(tight_helix),
    HARD(knot_void),
    HARD(sphere_of_poles),
    HARD(sphere_of_turned_diagonals),
    HARD(lens),
    HARD(long_triangles),
    HARD(long_triangles_both_ways),
    HARD(boxes_with_a_common_edge),
    HARD(boxes_with_a_common_corner),
    HARD(box_far_from_the_origin),
    HARD(warped_box),
#undef HARD
};

int hard_boundary_count(void) {
  return (int)(sizeof hard / sizeof *hard);
}

const char *hard_boundary(int number, Surface *surface, double *size) {
  memset(surface, 0, sizeof *surface);
  hard[number].make(surface, size);
  return hard[number].name;
}
