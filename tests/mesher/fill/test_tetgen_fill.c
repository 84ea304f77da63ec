// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fill_fault.h"
#include "mesher/common/vec.h"
#include "mesher/fill/tetgen_fill.h"
#include "tests/unit_test.h"

typedef struct {
  double size, growth, place[3]; // size + growth * distance from place
} Field;

static double size_at(const void *context, const double x[3]) {
  const Field *f = context;
  return f->size + f->growth * cw_distance(x, f->place);
}

static CwFillInput input_of(const Surface *s, const Field *field) {
  return surface_fill_input(s, size_at, field);
}

// All that a fill promises, and cells of good shape.
static void check(const Surface *s, const CwFill *fill) {
  const FillShape shape = check_fill(s, fill);
  assert_true(shape.dihedral_least >= 10.0);
  assert_true(shape.aspect_most <= 4.0);
  assert_true(shape.aspect_mean <= 1.55);
}

// How many cells there are.
static int32_t fill_and_check(const Surface *s, const Field *field) {
  CwFillInput input = input_of(s, field);
  CwFill fill;
  if (cw_tetgen_fill(&input, &fill) != CW_OK) fail_msg("%s", cw_fail_message());
  const int32_t count = fill.tetrahedron_count;
  check(s, &fill);
  cw_fill_free(&fill);
  return count;
}

static const double origin[3] = {0, 0, 0};

static void cube(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){12, 12, 12}, 1);
  assert_near(surface_volume(&s), 6.4e-5, 1e-18);
  const int32_t count = fill_and_check(&s, &(Field){.size = 0.04 / 12});
  // 6 sqrt(2) tetrahedra in h^3 for regular ones; right-angled triangles on the faces have longer edges than
  // h.
  double cells = 6.0 * sqrt(2.0) * 12 * 12 * 12;
  assert_true(count > 0.8 * cells && count < 1.1 * cells);
  surface_free(&s);
}

static void sphere(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  fill_and_check(&s, &(Field){.size = 0.0036});
  surface_free(&s);
}

static void coarse_shapes_without_inner_points(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 0, 1); // 20 triangles
  Field field = {.size = 0.05};
  CwFillInput input = input_of(&s, &field);
  CwFill fill;
  assert_int_equal(cw_tetgen_fill(&input, &fill), CW_OK);
  check_fill(&s, &fill);
  assert_true(fill.tetrahedron_count >= 15);
  cw_fill_free(&fill);
  surface_free(&s);
}

static void cube_with_a_void(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){-0.02, -0.02, -0.02}, (double[3]){0.02, 0.02, 0.02}, (int[3]){10, 10, 10}, 1);
  surface_add_sphere(&s, (double[3]){0.001, 0.002, 0}, 0.01, 2, 0);
  assert_true(surface_volume(&s) < 6.1e-5);
  fill_and_check(&s, &(Field){.size = 0.004});
  surface_free(&s);
}

// A ball with a void that holds a smaller ball: three shells, two bodies.
static void shell_in_a_void_of_a_shell(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 3, 1);
  surface_add_sphere(&s, origin, 0.03, 3, 0);
  surface_add_sphere(&s, (double[3]){0.001, 0, 0}, 0.02, 2, 1);
  double thirds = pow(0.05, 3) - pow(0.03, 3) + pow(0.02, 3);
  assert_near(surface_volume(&s) / (4.0 / 3.0 * 3.141592653589793 * thirds), 1.0, 0.03);
  fill_and_check(&s, &(Field){.size = 0.006});
  surface_free(&s);
}

static void thin_slab(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.06, 0.04, 0.004}, (int[3]){30, 20, 2}, 1);
  fill_and_check(&s, &(Field){.size = 0.002});
  surface_free(&s);
}

// Half an edge thick: nothing fits inside, but the boundary is kept and the volume right.
static void slab_thinner_than_the_size(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.02, 0.02, 0.001}, (int[3]){10, 10, 1}, 1);
  Field field = {.size = 0.002};
  CwFillInput input = input_of(&s, &field);
  CwFill fill;
  if (cw_tetgen_fill(&input, &fill) != CW_OK) fail_msg("%s", cw_fail_message());
  check_fill(&s, &fill);
  assert_near(surface_volume(&s), 4e-7, 1e-18);
  cw_fill_free(&fill);
  surface_free(&s);
}

// Size grows away from one place: cell sizes follow.
static void graded_size(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  Field field = {.size = 0.0015, .growth = 0.045};
  CwFillInput input = input_of(&s, &field);
  CwFill fill;
  if (cw_tetgen_fill(&input, &fill) != CW_OK) fail_msg("%s", cw_fail_message());
  check(&s, &fill);
  double wanted = 0.0;
  int32_t near_count = 0;
  for (int32_t t = 0; t < fill.tetrahedron_count; t++) {
    double mean[3] = {0, 0, 0};
    for (int i = 0; i < 4; i++) {
      for (int k = 0; k < 3; k++) mean[k] += 0.25 * fill.x[fill.tetrahedron[t][i]][k];
    }
    if (sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]) < 0.01) near_count++;
  }
  // In the ball of 10 mm: integral of 6 sqrt(2) / h^3 by shells.
  for (int k = 0; k < 1000; k++) {
    double r = 0.01 * (k + 0.5) / 1000.0, h = field.size + field.growth * r;
    wanted += 6.0 * sqrt(2.0) * 4.0 * 3.141592653589793 * r * r * 0.01 / 1000.0 / (h * h * h);
  }
  assert_true(near_count > 0.6 * wanted && near_count < 1.7 * wanted); // sizes come in powers of two
  cw_fill_free(&fill);
  surface_free(&s);
}

static void equal_bits_twice(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 3, 1);
  surface_add_sphere(&s, (double[3]){0.01, 0, 0}, 0.02, 2, 0);
  Field field = {.size = 0.006};
  CwFillInput input = input_of(&s, &field);
  CwFill a, b;
  assert_int_equal(cw_tetgen_fill(&input, &a), CW_OK);
  void *shift = malloc(12345); // other addresses the second time
  assert_int_equal(cw_tetgen_fill(&input, &b), CW_OK);
  assert_int_equal(a.point_count, b.point_count);
  assert_int_equal(a.tetrahedron_count, b.tetrahedron_count);
  assert_memory_equal(a.x, b.x, (size_t)a.point_count * sizeof *a.x);
  assert_memory_equal(a.tetrahedron, b.tetrahedron, (size_t)a.tetrahedron_count * sizeof *a.tetrahedron);
  free(shift);
  cw_fill_free(&a);
  cw_fill_free(&b);
  surface_free(&s);
}

static void fails_with(const Surface *s, const Field *field, const char *part) {
  CwFillInput input = input_of(s, field);
  CwFill fill;
  cw_fail_clear();
  assert_int_equal(cw_tetgen_fill(&input, &fill), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "rotor region 3"));
  if (!strstr(cw_fail_message(), part)) fail_msg("\"%s\" lacks \"%s\"", cw_fail_message(), part);
}

static void open_boundary_is_named_with_its_place(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){1, 1, 1}, 1);
  Field field = {.size = 0.02};
  s.triangle_count--;
  fails_with(&s, &field, "open");
  fails_with(&s, &field, "mm");
  s.triangle_count++;
  int32_t kept = s.triangle[0][0];
  s.triangle[0][0] = s.triangle[0][1];
  s.triangle[0][1] = kept;
  fails_with(&s, &field, "turned over");
  surface_free(&s);
}

static void boundary_turned_inside_out(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 2, 0);
  fails_with(&s, &(Field){.size = 0.015}, "normals point inward");
  surface_free(&s);
}

static void self_intersection_is_named_with_its_place(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){4, 4, 4}, 1);
  surface_add_sphere(&s, (double[3]){0.0403, 0.0211, 0.0207}, 0.01, 1, 1); // half out
  fails_with(&s, &(Field){.size = 0.01}, "crosses itself");
  double at[3];
  const char *place = strchr(cw_fail_message(), '(');
  assert_non_null(place);
  assert_int_equal(sscanf(place, "(%lf, %lf, %lf) mm", &at[0], &at[1], &at[2]), 3);
  assert_near(at[0], 40.0, 11.0);
  assert_near(at[1], 20.0, 11.0);
  assert_near(at[2], 20.0, 11.0);
  surface_free(&s);
}

static void coinciding_points_are_an_error(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.02, 0.02, 0.02}, (int[3]){2, 2, 2}, 1);
  surface_add_box(&s, (double[3]){0.02, 0, 0}, (double[3]){0.04, 0.02, 0.02}, (int[3]){2, 2, 2}, 1);
  fails_with(&s, &(Field){.size = 0.01}, "coincide");
  surface_free(&s);
}

static void wrong_size_field_is_an_error(void **state) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 1, 1);
  fails_with(&s, &(Field){.size = 0.0}, "size field");
  surface_free(&s);
}

static double size_with_a_hole(const void *context, const double x[3]) {
  return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] < 4e-4 ? NAN : *(const double *)context;
}

static void size_field_with_a_hole_is_an_error(void **state) {
  Surface s = {0};
  const double size = 0.01;
  surface_add_sphere(&s, origin, 0.05, 2, 1);
  CwFillInput input = input_of(&s, NULL);
  CwFill fill;
  input.size = size_with_a_hole;
  input.size_context = &size;
  assert_int_equal(cw_tetgen_fill(&input, &fill), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "rotor region 3: the size field gives nan mm at ("));
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cube),
      cmocka_unit_test(sphere),
      cmocka_unit_test(coarse_shapes_without_inner_points),
      cmocka_unit_test(cube_with_a_void),
      cmocka_unit_test(shell_in_a_void_of_a_shell),
      cmocka_unit_test(thin_slab),
      cmocka_unit_test(slab_thinner_than_the_size),
      cmocka_unit_test(graded_size),
      cmocka_unit_test(equal_bits_twice),
      cmocka_unit_test(open_boundary_is_named_with_its_place),
      cmocka_unit_test(boundary_turned_inside_out),
      cmocka_unit_test(self_intersection_is_named_with_its_place),
      cmocka_unit_test(coinciding_points_are_an_error),
      cmocka_unit_test(wrong_size_field_is_an_error),
      cmocka_unit_test(size_field_with_a_hole_is_an_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
