// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hard_boundaries.h"

#include "hard_polyhedra.h"
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
      {0, 0}, {0.04 * cos(a), 0.04 * sin(a)}, {0.04, 0.02}, {-0.02, 0.02}, {-0.02, -0.02}, {0.04, -0.02}, {0.04, 0}};
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
  for (int k = 0; k < n; k++) shape_point(s, 0.002 * cos(2 * PI * k / n), 0.002 * sin(2 * PI * k / n), 0);
  for (int k = 0; k < n; k++) {
    surface_facing(s, first + k, first + (k + 1) % n, tip, 1);
    surface_facing(s, first + (k + 1) % n, first + k, foot, 1);
  }
  *size = 0.001;
}

static void spikes(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.01, 2, 1);
  for (int32_t p = 0; p < s->point_count; p += 5) {
    for (int i = 0; i < 3; i++) s->x[p][i] *= 5.0;
  }
  *size = 0.003;
}

static void dents(Surface *s, double *size) {
  shape_ball(s, 0, 0, 0, 0.01, 2, 1);
  for (int32_t p = 0; p < s->point_count; p += 5) {
    for (int i = 0; i < 3; i++) s->x[p][i] *= 0.05;
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
  for (int k = 0; k < 5; k++) shape_ball(s, 0.0004 * k, 0, 0, 0.05 - 0.008 * k, k < 3 ? 3 : 2, k % 2 == 0);
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
      surface_facing(s, a + r, a + q, a + rows + q, 1);
      surface_facing(s, a + r, a + rows + q, a + rows + r, 1);
    }
    surface_facing(s, south, base + q, base + r, 1);
    surface_facing(s, north, base + (columns - 2) * rows + r, base + (columns - 2) * rows + q, 1);
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
  for (int32_t p = 0; p < s->point_count; p++) s->x[p][2] *= 0.05;
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
      for (int i = 0; i < 3; i++) d += fabs(s->x[q][i] - other.x[p][i]);
      if (d < 1e-9) number[p] = q;
    }
    if (number[p] < 0) number[p] = shape_point(s, other.x[p][0], other.x[p][1], other.x[p][2]);
  }
  for (int32_t t = 0; t < other.triangle_count; t++)
    surface_facing(s, number[other.triangle[t][0]], number[other.triangle[t][1]], number[other.triangle[t][2]], 1);
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
    for (int i = 0; i < 3; i++) s->x[p][i] += 1000.0 * (i + 1);
  }
}

static void warped_box(Surface *s, double *size) {
  uint64_t seed = 12;
  shape_box(s, 0, 0, 0, 0.04, 0.04, 0.04, 8, 8, 8, 1);
  for (int32_t p = 0; p < 3 * s->point_count; p++) s->x[p / 3][p % 3] += 0.0022 * (draw(&seed) - 0.5);
  *size = 0.005;
}

static const HardBoundary hard[] = {
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
};

enum { HARD_COUNT = sizeof hard / sizeof *hard };

int hard_boundary_count(void) {
  return HARD_COUNT + hard_polyhedra_count;
}

const char *hard_boundary(int number, Surface *surface, double *size) {
  const HardBoundary *one = number < HARD_COUNT ? &hard[number] : &hard_polyhedra[number - HARD_COUNT];
  memset(surface, 0, sizeof *surface);
  one->make(surface, size);
  return one->name;
}
