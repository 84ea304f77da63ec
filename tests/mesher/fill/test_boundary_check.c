// SPDX-License-Identifier: AGPL-3.0-or-later
// What is no boundary is refused by each way to fill, with one line that names the region and a place.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fill_fault.h"
#include "hard_boundaries.h"
#include "mesher/fill/boundary_check.h"
#include "mesher/fill/fill_with_fallback.h"
#include "mesher/fill/kernel.h"
#include "mesher/fill/tetgen_fill.h"
#include "tests/unit_test.h"

static const double origin[3] = {0, 0, 0};

// The message must hold `part`, the region, and where `at` is given a place within `near` mm of it.
static void refused(const Surface *s, double size, const char *part, const double at[3], double near) {
  CwFillInput input = fill_input(s, &size);
  for (int way = 0; way < 3; way++) {
    CwFill fill;
    cw_fail_clear();
    CwKernelOutcome outcome;
    CwStatus status = way == 0   ? cw_kernel_fill(&input, &fill, &outcome)
                      : way == 1 ? cw_tetgen_fill(&input, &fill)
                                 : cw_fill_with_fallback(&input, CW_FILL_KERNEL, &fill);
    const char *message = cw_fail_message(), *place = strchr(message, '(');
    if (status != CW_ERR_MESH) fail_msg("way %d gives %d, not an error that says \"%s\"", way, status, part);
    assert_null(fill.tetrahedron);
    assert_null(fill.x);
    assert_null(strchr(message, '\n'));
    if (!strstr(message, part) || !strstr(message, "rotor region 3: ")) fail_msg("\"%s\" lacks \"%s\"", message, part);
    double x[3], distance = INFINITY;
    for (; at && place; place = strchr(place + 1, '(')) { // the nearest of the places
      if (sscanf(place, "(%lf, %lf, %lf)", &x[0], &x[1], &x[2]) == 3)
        distance = fmin(distance, hypot(hypot(x[0] - at[0], x[1] - at[1]), x[2] - at[2]));
    }
    if (at && !(distance <= near)) fail_msg("\"%s\" names no place near (%g, %g, %g)", message, at[0], at[1], at[2]);
  }
}

static Surface cube_of_8(void) {
  Surface s = {0};
  surface_add_box(&s, origin, (double[3]){0.04, 0.04, 0.04}, (int[3]){4, 4, 4}, 1);
  return s;
}

static void middle_of(const Surface *s, int32_t t, double mm[3]) {
  for (int i = 0; i < 3; i++)
    mm[i] = 1e3 / 3.0 * (s->x[s->triangle[t][0]][i] + s->x[s->triangle[t][1]][i] + s->x[s->triangle[t][2]][i]);
}

static void hole(void **unused) {
  Surface s = cube_of_8();
  double at[3];
  middle_of(&s, s.triangle_count - 1, at);
  s.triangle_count--;
  refused(&s, 0.01, "open", at, 11.0);
  surface_free(&s);
}

static void slit(void **unused) { // a point doubled: the boundary is torn along two edges
  Surface s = cube_of_8();
  int32_t t = 17, p = s.triangle[t][0];
  const double x[3] = {s.x[p][0] + 1e-4, s.x[p][1], s.x[p][2]};
  const double at[3] = {1e3 * x[0], 1e3 * x[1], 1e3 * x[2]};
  int32_t q = surface_point(&s, x);
  s.triangle[t][0] = q;
  refused(&s, 0.01, "open", at, 15.0);
  surface_free(&s);
}

static void fin_on_an_edge(void **unused) { // three triangles at an edge
  Surface s = cube_of_8();
  int32_t a = s.triangle[40][0], b = s.triangle[40][1];
  double x[3] = {0.1, 0.1, 0.1};
  int32_t c = surface_point_from(&s, x, 0);
  surface_facing(&s, a, b, c, 1);
  refused(&s, 0.01, "open", NULL, 0.0);
  surface_facing(&s, a, b, c, 0); // and its back: closed, but twice the same
  refused(&s, 0.01, "", (double[3]){1e3 * s.x[a][0], 1e3 * s.x[a][1], 1e3 * s.x[a][2]}, 100.0);
  surface_free(&s);
}

static void doubled_triangle(void **unused) {
  Surface s = cube_of_8();
  double at[3];
  middle_of(&s, 33, at);
  surface_facing(&s, s.triangle[33][0], s.triangle[33][1], s.triangle[33][2], 1);
  refused(&s, 0.01, "open or turned over", at, 11.0);
  surface_free(&s);
}

static void turned_triangle(void **unused) {
  Surface s = cube_of_8();
  double at[3];
  middle_of(&s, 50, at);
  int32_t swap = s.triangle[50][0];
  s.triangle[50][0] = s.triangle[50][1];
  s.triangle[50][1] = swap;
  refused(&s, 0.01, "turned over", at, 11.0);
  surface_free(&s);
}

static void inside_out(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 2, 0);
  refused(&s, 0.015, "point inward", NULL, 0.0);
  surface_free(&s);
}

static void one_of_two_bodies_inside_out(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 2, 1);
  surface_add_sphere(&s, (double[3]){0.2, 0, 0}, 0.05, 2, 0);
  refused(&s, 0.015, "normals", NULL, 0.0);
  surface_free(&s);
}

static void void_turned_outward(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 2, 1);
  surface_add_sphere(&s, origin, 0.02, 2, 1);
  refused(&s, 0.015, "normals disagree", origin, 60.0);
  surface_free(&s);
}

static void crossing_spheres(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 3, 1);
  surface_add_sphere(&s, (double[3]){0.06, 0, 0}, 0.05, 3, 1);
  refused(&s, 0.008, "crosses itself", (double[3]){30, 0, 0}, 50.0);
  surface_free(&s);
}

static void sphere_half_out_of_a_box(void **unused) {
  Surface s = cube_of_8();
  surface_add_sphere(&s, (double[3]){0.0403, 0.0211, 0.0207}, 0.01, 1, 1);
  refused(&s, 0.01, "crosses itself", (double[3]){40, 21, 21}, 12.0);
  surface_free(&s);
}

static void bent_over_itself(void **unused) { // a tongue of one closed surface goes through its other side
  Surface s = cube_of_8();
  for (int32_t p = 0; p < s.point_count; p++) {
    if (s.x[p][0] == 0.02 && s.x[p][1] == 0.02 && s.x[p][2] == 0.0) s.x[p][2] = 0.05;
  }
  refused(&s, 0.01, "crosses itself", (double[3]){20, 20, 40}, 30.0);
  surface_free(&s);
}

// The tip of one body stands exactly on a face of the other.
static void corner_on_a_face(void **unused) {
  Surface s = {0};
  surface_add_box(&s, origin, (double[3]){0.04, 0.04, 0.04}, (int[3]){1, 1, 1}, 1);
  int32_t p[4];
  const double x[4][3] = {{0.02, 0.015, 0.04}, {0.01, 0.01, 0.06}, {0.03, 0.01, 0.06}, {0.02, 0.03, 0.06}};
  for (int k = 0; k < 4; k++) p[k] = surface_point(&s, x[k]);
  surface_facing(&s, p[1], p[2], p[3], 1);
  surface_facing(&s, p[0], p[2], p[1], 1);
  surface_facing(&s, p[0], p[3], p[2], 1);
  surface_facing(&s, p[0], p[1], p[3], 1);
  assert_true(surface_volume(&s) > 6.4e-5);
  refused(&s, 0.04, "crosses itself", (double[3]){20, 20, 40}, 30.0);
  surface_free(&s);
}

static void faces_that_lie_on_each_other(void **unused) { // two boxes share a plane, but no points
  Surface s = {0};
  surface_add_box(&s, origin, (double[3]){0.04, 0.04, 0.04}, (int[3]){3, 3, 3}, 1);
  surface_add_box(&s, (double[3]){0.04, 0.005, 0.005}, (double[3]){0.05, 0.031, 0.033}, (int[3]){2, 2, 2}, 1);
  refused(&s, 0.01, "crosses itself", (double[3]){40, 20, 20}, 30.0);
  surface_free(&s);
}

static void points_that_coincide(void **unused) {
  Surface s = cube_of_8();
  surface_add_box(&s, (double[3]){0.04, 0, 0}, (double[3]){0.08, 0.04, 0.04}, (int[3]){4, 4, 4}, 1);
  refused(&s, 0.01, "coincide", (double[3]){40, 20, 20}, 30.0);
  surface_free(&s);
}

static void triangle_without_area(void **unused) { // a point on an edge of a triangle, joined by a flat one
  Surface s = {0};
  surface_add_box(&s, origin, (double[3]){0.04, 0.04, 0.04}, (int[3]){1, 1, 1}, 1);
  int32_t a = s.triangle[0][0], b = s.triangle[0][1], c = s.triangle[0][2];
  double x[3];
  for (int i = 0; i < 3; i++) x[i] = 0.5 * (s.x[a][i] + s.x[b][i]);
  int32_t n = surface_point(&s, x);
  s.triangle[0][1] = n; // a n c, n b c, and a b n without area
  surface_facing(&s, n, b, c, 1);
  surface_facing(&s, a, b, n, 1);
  refused(&s, 0.04, "no area", (double[3]){1e3 * x[0], 1e3 * x[1], 1e3 * x[2]}, 1e-3);
  surface_free(&s);
}

static void coordinates_that_are_none(void **unused) {
  const double wrong[3] = {NAN, INFINITY, -INFINITY};
  for (int k = 0; k < 3; k++) {
    Surface s = cube_of_8();
    s.x[30][k] = wrong[k];
    refused(&s, 0.01, "point 30 is not finite", NULL, 0.0);
    surface_free(&s);
  }
}

static void wrong_indices(void **unused) {
  const int32_t wrong[3] = {-1, 1000, 0};
  for (int k = 0; k < 3; k++) {
    Surface s = cube_of_8();
    int32_t kept = s.triangle[5][1];
    s.triangle[5][1] = k == 2 ? s.triangle[5][0] : wrong[k];
    refused(&s, 0.01, "boundary triangle 5 has points", NULL, 0.0);
    s.triangle[5][1] = kept;
    surface_free(&s);
  }
}

static void too_few_triangles(void **unused) {
  Surface s = {0};
  refused(&s, 0.01, "at least 4", NULL, 0.0);
}

static void sound_ones_pass(void **unused) {
  for (int k = 0; k < hard_boundary_count(); k++) {
    Surface s;
    double size;
    hard_boundary(k, &s, &size);
    CwFillInput input = fill_input(&s, &size);
    assert_int_equal(cw_boundary_check(&input), CW_OK);
    assert_int_equal(cw_boundary_check_crossing(&input), CW_OK);
    surface_free(&s);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hole),
      cmocka_unit_test(slit),
      cmocka_unit_test(fin_on_an_edge),
      cmocka_unit_test(doubled_triangle),
      cmocka_unit_test(turned_triangle),
      cmocka_unit_test(inside_out),
      cmocka_unit_test(one_of_two_bodies_inside_out),
      cmocka_unit_test(void_turned_outward),
      cmocka_unit_test(crossing_spheres),
      cmocka_unit_test(sphere_half_out_of_a_box),
      cmocka_unit_test(bent_over_itself),
      cmocka_unit_test(corner_on_a_face),
      cmocka_unit_test(faces_that_lie_on_each_other),
      cmocka_unit_test(points_that_coincide),
      cmocka_unit_test(triangle_without_area),
      cmocka_unit_test(coordinates_that_are_none),
      cmocka_unit_test(wrong_indices),
      cmocka_unit_test(too_few_triangles),
      cmocka_unit_test(sound_ones_pass),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
