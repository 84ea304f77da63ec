// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fill_fault.h"
#include "mesher/fill/delaunay.h"
#include "mesher/fill/kernel.h"
#include "surface_shapes.h"
#include "tests/unit_test.h"

static FillShape fill_and_check(const Surface *s, double size) {
  CwFillInput input = fill_input(s, &size);
  CwFill fill;
  CwKernelOutcome outcome;
  if (cw_kernel_fill(&input, &fill, &outcome) != CW_OK) fail_msg("%s", cw_fail_message());
  assert_int_equal(outcome, CW_KERNEL_FILLED);
  FillShape shape = check_fill(s, &fill);
  cw_fill_free(&fill);
  return shape;
}

static const double origin[3] = {0, 0, 0};

static void sphere(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  FillShape shape = fill_and_check(&s, 0.0036);
  assert_true(shape.dihedral_least > 15.0);
  assert_true(shape.aspect_mean < 1.5);
  surface_free(&s);
}

// Cocircular points everywhere: half of the diagonals are wrong for the mesh as it comes.
static void cube(void **unused) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){12, 12, 12}, 1);
  FillShape shape = fill_and_check(&s, 0.04 / 12);
  assert_true(shape.dihedral_least > 10.0);
  surface_free(&s);
}

// From a mesh that is Delaunay already: its points come one by one, an inner one among those of the boundary.
static void from_a_delaunay_mesh(void **unused) {
  Surface s = {0};
  CwTetMesh mesh;
  CwDelaunayInsertion *insertion;
  CwFill fill;
  CwKernelOutcome outcome;
  double size = 0.01;
  int32_t point;
  surface_add_sphere(&s, origin, 0.05, 3, 1);
  CwFillInput input = fill_input(&s, &size);
  assert_int_equal(cw_delaunay_make(input.point_count - 1, input.x, &mesh), CW_OK);
  assert_int_equal(cw_delaunay_open(&mesh, &insertion), CW_OK);
  assert_int_equal(cw_delaunay_insert(insertion, origin, input.point_count, -1, &point), CW_OK);
  assert_int_equal(cw_delaunay_insert(insertion, input.x[input.point_count - 1], input.point_count - 1, -1, &point),
                   CW_OK);
  cw_delaunay_close(&insertion);
  if (cw_kernel_finish(&input, &mesh, input.point_count + 1, &fill, &outcome) != CW_OK)
    fail_msg("%s", cw_fail_message());
  assert_int_equal(outcome, CW_KERNEL_FILLED);
  assert_true(check_fill(&s, &fill).dihedral_least > 5.0);
  cw_fill_free(&fill);
  surface_free(&s);
}

static void coarse_without_inner_points(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 0, 1);
  fill_and_check(&s, 0.05);
  surface_free(&s);
}

static void shell_in_a_void_of_a_shell(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 3, 1);
  surface_add_sphere(&s, origin, 0.03, 3, 0);
  surface_add_sphere(&s, (double[3]){0.001, 0, 0}, 0.02, 2, 1);
  fill_and_check(&s, 0.006);
  surface_free(&s);
}

static void thin_slabs(void **unused) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.06, 0.04, 0.004}, (int[3]){30, 20, 2}, 1);
  fill_and_check(&s, 0.002);
  surface_free(&s);
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.02, 0.02, 0.001}, (int[3]){10, 10, 1}, 1);
  fill_and_check(&s, 0.002);
  surface_free(&s);
}

static void wrong_diagonals_are_recovered(void **unused) {
  for (uint32_t seed = 1; seed <= 6; seed++) {
    Surface s = {0};
    surface_add_sphere(&s, origin, 0.05, 4, 1);
    assert_true(shape_turn_diagonals(&s, seed, seed % 2 ? 40 : 12) > 40);
    fill_and_check(&s, 0.0036);
    surface_free(&s);
  }
}

// A long thin needle of triangles on a box: edges three times as long as the box is thick.
static void stretched_triangles(void **unused) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.06, 0.02, 0.01}, (int[3]){6, 8, 5}, 1);
  fill_and_check(&s, 0.005);
  surface_free(&s);
}

// E. Schoenhardt's prism, the upper triangle of which is turned against the diagonals of its sides, has no
// tetrahedralization without a point inside (Ueber die Zerlegung von Dreieckspolyedern in Tetraeder, 1928).
static void a_polyhedron_that_needs_a_point_inside(void **unused) {
  for (int degrees = 10; degrees <= 50; degrees += 20) {
    Surface s = {0};
    double size = 0.01;
    for (int k = 0; k < 6; k++) {
      double a = M_PI * (120 * (k % 3) - (k < 3 ? 0 : degrees)) / 180;
      shape_point(&s, size * cos(a), size * sin(a), k < 3 ? 0 : size);
    }
    for (int k = 0; k < 3; k++) {
      surface_facing(&s, k, (k + 1) % 3, k + 3, 1);
      surface_facing(&s, (k + 1) % 3, (k + 1) % 3 + 3, k + 3, 1);
    }
    surface_facing(&s, 0, 2, 1, 1);
    surface_facing(&s, 3, 4, 5, 1);
    CwFillInput input = fill_input(&s, &size);
    CwFill fill;
    CwKernelOutcome outcome;
    assert_int_equal(cw_kernel_fill(&input, &fill, &outcome), CW_OK);
    assert_int_equal(outcome, CW_KERNEL_FILLED);
    assert_true(fill.recovery.missing > 0 && fill.point_count > 6);
    check_fill(&s, &fill);
    cw_fill_free(&fill);
    surface_free(&s);
  }
}

static void equal_bits_twice(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  shape_turn_diagonals(&s, 5, 12);
  double size = 0.0036;
  CwFillInput input = fill_input(&s, &size);
  CwFill one, two;
  CwKernelOutcome outcome;
  assert_int_equal(cw_kernel_fill(&input, &one, &outcome), CW_OK);
  assert_int_equal(cw_kernel_fill(&input, &two, &outcome), CW_OK);
  assert_int_equal(one.point_count, two.point_count);
  assert_int_equal(one.tetrahedron_count, two.tetrahedron_count);
  assert_memory_equal(one.x, two.x, (size_t)one.point_count * sizeof *one.x);
  assert_memory_equal(one.tetrahedron, two.tetrahedron, (size_t)one.tetrahedron_count * sizeof *one.tetrahedron);
  cw_fill_free(&one);
  cw_fill_free(&two);
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sphere),
      cmocka_unit_test(cube),
      cmocka_unit_test(from_a_delaunay_mesh),
      cmocka_unit_test(coarse_without_inner_points),
      cmocka_unit_test(shell_in_a_void_of_a_shell),
      cmocka_unit_test(thin_slabs),
      cmocka_unit_test(wrong_diagonals_are_recovered),
      cmocka_unit_test(stretched_triangles),
      cmocka_unit_test(a_polyhedron_that_needs_a_point_inside),
      cmocka_unit_test(equal_bits_twice),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
