// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "mesher/fill_shape.h"
#include "mesher/kernel.h"
#include "mesher/predicates.h"
#include "mesher/quality.h"
#include "closed_surfaces.h"

#define NEAR(value, wanted, tolerance) assert_true(fabs((value) - (wanted)) <= (tolerance))

static double constant_size(const void *context, const double x[3]) {
  return *(const double *)context;
}

static CwFillInput input_of(const Surface *s, const double *size) {
  return (CwFillInput){.point_count = s->point_count,
                       .x = (const double(*)[3])s->x,
                       .triangle_count = s->triangle_count,
                       .triangle = (const int32_t(*)[3])s->triangle,
                       .size = constant_size,
                       .size_context = size,
                       .name = "rotor region 3"};
}

static int compare_triples(const void *a, const void *b) {
  return memcmp(a, b, 3 * sizeof(int32_t));
}

static void least_first(const int32_t p[3], int32_t out[3]) {
  int least = p[0] < p[1] ? (p[0] < p[2] ? 0 : 2) : (p[1] < p[2] ? 1 : 2);
  for (int k = 0; k < 3; k++)
    out[k] = p[(least + k) % 3];
}

typedef struct {
  double dihedral_least, aspect_mean;
} Shape;

// Points kept, all cells positive, and the open faces are the given triangles, turned as given, none more.
static Shape check(const Surface *s, const CwFill *fill) {
  static const int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  Shape worst = {180.0, 0.0};
  int32_t(*neighbour)[4] = malloc((size_t)fill->tetrahedron_count * sizeof *neighbour);
  int32_t(*open)[3] = malloc((size_t)s->triangle_count * sizeof *open), opened = 0;
  int32_t(*given)[3] = malloc((size_t)s->triangle_count * sizeof *given);
  uint8_t *used = calloc((size_t)fill->point_count, 1);
  double six = 0.0, volume = surface_volume(s);
  assert_true(fill->point_count >= s->point_count);
  assert_memory_equal(fill->x, s->x, (size_t)s->point_count * sizeof *s->x);
  assert_int_equal(cw_tet_neighbours(fill->point_count, fill->tetrahedron_count,
                                     (const int32_t(*)[4])fill->tetrahedron, neighbour),
                   CW_OK);
  for (int32_t t = 0; t < fill->tetrahedron_count; t++) {
    const int32_t *p = fill->tetrahedron[t];
    const double *x[4];
    CwTetShape shape;
    for (int i = 0; i < 4; i++) {
      x[i] = fill->x[p[i]];
      used[p[i]] = 1;
    }
    assert_int_equal(cw_orient3d(x[0], x[1], x[2], x[3]), 1);
    six += cw_tet_volume6(x[0], x[1], x[2], x[3]);
    cw_tet_shape(x, &shape);
    worst.dihedral_least = fmin(worst.dihedral_least, shape.dihedral_least);
    worst.aspect_mean += shape.edge_longest / shape.edge_shortest / fill->tetrahedron_count;
    for (int i = 0; i < 4; i++) {
      if (neighbour[t][i] >= 0)
        continue;
      assert_true(opened < s->triangle_count);
      const int32_t q[3] = {p[face[i][0]], p[face[i][1]], p[face[i][2]]};
      least_first(q, open[opened++]);
    }
  }
  assert_int_equal(opened, s->triangle_count);
  for (int32_t t = 0; t < s->triangle_count; t++)
    least_first(s->triangle[t], given[t]);
  qsort(open, (size_t)opened, sizeof *open, compare_triples);
  qsort(given, (size_t)opened, sizeof *given, compare_triples);
  assert_memory_equal(open, given, (size_t)opened * sizeof *open);
  for (int32_t p = 0; p < fill->point_count; p++)
    assert_true(used[p]);
  NEAR(six / 6.0, volume, 1e-12 * volume);
  free(neighbour);
  free(open);
  free(given);
  free(used);
  return worst;
}

static Shape fill_and_check(const Surface *s, double size) {
  CwFillInput input = input_of(s, &size);
  CwFill fill;
  CwStatus status = cw_kernel_fill(&input, &fill);
  if (status == CW_RETRY)
    fail_msg("not recovered");
  if (status != CW_OK)
    fail_msg("%s", cw_fail_message());
  Shape shape = check(s, &fill);
  cw_fill_free(&fill);
  return shape;
}

static const double origin[3] = {0, 0, 0};

static void sphere(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  Shape shape = fill_and_check(&s, 0.0036);
  assert_true(shape.dihedral_least > 15.0);
  assert_true(shape.aspect_mean < 1.5);
  surface_free(&s);
}

// Cocircular points everywhere: half of the diagonals are wrong for the mesh as it comes.
static void cube(void **unused) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){12, 12, 12}, 1);
  Shape shape = fill_and_check(&s, 0.04 / 12);
  assert_true(shape.dihedral_least > 10.0);
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

static int has_edge(const Surface *s, int32_t a, int32_t b) {
  for (int32_t t = 0; t < s->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      if (s->triangle[t][k] == a && s->triangle[t][(k + 1) % 3] == b)
        return 1;
    }
  }
  return 0;
}

// Turns the diagonal of two triangles wherever `seed` says so, none twice: a surface that is far from
// Delaunay.
static int turn_diagonals(Surface *s, uint32_t seed, int one_in) {
  uint8_t *done = calloc((size_t)s->triangle_count, 1);
  int turned = 0;
  for (int32_t t = 0; t < s->triangle_count; t++) {
    seed = seed * 1664525u + 1013904223u;
    if (done[t] || (seed >> 16) % (uint32_t)one_in)
      continue;
    int32_t a = s->triangle[t][0], b = s->triangle[t][1], c = s->triangle[t][2];
    for (int32_t o = 0; o < s->triangle_count; o++) {
      int k = 0;
      while (k < 3 && !(s->triangle[o][k] == b && s->triangle[o][(k + 1) % 3] == a))
        k++;
      if (k == 3)
        continue;
      int32_t d = s->triangle[o][(k + 2) % 3];
      if (done[o] || d == c || has_edge(s, c, d) || has_edge(s, d, c))
        break;
      done[t] = done[o] = 1;
      const int32_t one[3] = {a, d, c}, two[3] = {d, b, c};
      memcpy(s->triangle[t], one, sizeof one);
      memcpy(s->triangle[o], two, sizeof two);
      turned++;
      break;
    }
  }
  free(done);
  return turned;
}

static void wrong_diagonals_are_recovered(void **unused) {
  for (uint32_t seed = 1; seed <= 6; seed++) {
    Surface s = {0};
    surface_add_sphere(&s, origin, 0.05, 4, 1);
    assert_true(turn_diagonals(&s, seed, seed % 2 ? 40 : 12) > 40);
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

static void equal_bits_twice(void **unused) {
  Surface s = {0};
  surface_add_sphere(&s, origin, 0.05, 4, 1);
  turn_diagonals(&s, 5, 12);
  double size = 0.0036;
  CwFillInput input = input_of(&s, &size);
  CwFill one, two;
  assert_int_equal(cw_kernel_fill(&input, &one), CW_OK);
  assert_int_equal(cw_kernel_fill(&input, &two), CW_OK);
  assert_int_equal(one.point_count, two.point_count);
  assert_int_equal(one.tetrahedron_count, two.tetrahedron_count);
  assert_memory_equal(one.x, two.x, (size_t)one.point_count * sizeof *one.x);
  assert_memory_equal(one.tetrahedron, two.tetrahedron,
                      (size_t)one.tetrahedron_count * sizeof *one.tetrahedron);
  cw_fill_free(&one);
  cw_fill_free(&two);
  surface_free(&s);
}

static CwStatus status_of(const Surface *s, double size) {
  CwFillInput input = input_of(s, &size);
  CwFill fill;
  CwStatus status = cw_kernel_fill(&input, &fill);
  assert_null(fill.tetrahedron);
  return status;
}

static void boundaries_that_cannot_be_filled(void **unused) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){4, 4, 4}, 1);
  s.triangle_count--;
  assert_int_equal(status_of(&s, 0.01), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "open"));
  s.triangle_count++;
  surface_add_sphere(&s, (double[3]){0.0403, 0.0211, 0.0207}, 0.01, 1, 1); // half out: crosses the box
  assert_int_equal(status_of(&s, 0.01), CW_RETRY);
  surface_free(&s);
  surface_add_sphere(&s, origin, 0.05, 2, 0);
  assert_int_equal(status_of(&s, 0.015), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "normals point inward"));
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sphere),
      cmocka_unit_test(cube),
      cmocka_unit_test(coarse_without_inner_points),
      cmocka_unit_test(shell_in_a_void_of_a_shell),
      cmocka_unit_test(thin_slabs),
      cmocka_unit_test(wrong_diagonals_are_recovered),
      cmocka_unit_test(stretched_triangles),
      cmocka_unit_test(equal_bits_twice),
      cmocka_unit_test(boundaries_that_cannot_be_filled),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
