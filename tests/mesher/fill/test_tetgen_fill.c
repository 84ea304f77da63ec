// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "closed_surfaces.h"
#include "mesher/common/quality.h"
#include "mesher/fill/fill_shape.h"
#include "mesher/fill/tetgen_fill.h"
#include "mesher/region/audit.h"
#include "tests/unit_test.h"

typedef struct {
  double size, growth, place[3]; // size + growth * distance from place
} Field;

static double size_at(const void *context, const double x[3]) {
  const Field *f = context;
  double square = 0.0;
  for (int i = 0; i < 3; i++) square += (x[i] - f->place[i]) * (x[i] - f->place[i]);
  return f->size + f->growth * sqrt(square);
}

static CwFillInput input_of(const Surface *s, const Field *field) {
  return surface_fill_input(s, size_at, field);
}

static int compare_triples(const void *a, const void *b) {
  return memcmp(a, b, 3 * sizeof(int32_t));
}

// All that a fill promises; gives its quality.
static CwQuality check_fill(const Surface *s, const CwFill *fill) {
  CwQuality quality;
  assert_true(fill->point_count >= s->point_count);
  assert_memory_equal(fill->x, s->x, (size_t)s->point_count * sizeof *s->x);

  // With every boundary triangle listed, the audit proves each to be the face of exactly one tetrahedron,
  // with the normal out, and that no other face is open. The cell of each is found by its sorted corners.
  static const int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  int32_t(*key)[4] = malloc(4 * (size_t)fill->tetrahedron_count * sizeof *key);
  int32_t count = 0;
  for (int32_t t = 0; t < fill->tetrahedron_count; t++) {
    for (int i = 0; i < 4; i++) {
      int32_t p[3];
      int inner = 0;
      for (int k = 0; k < 3; k++) {
        p[k] = fill->tetrahedron[t][face[i][k]];
        inner |= p[k] >= s->point_count;
      }
      if (inner) continue;
      int least = p[0] < p[1] ? (p[0] < p[2] ? 0 : 2) : (p[1] < p[2] ? 1 : 2);
      for (int k = 0; k < 3; k++) key[count][k] = p[(least + k) % 3];
      key[count++][3] = t;
    }
  }
  qsort(key, (size_t)count, sizeof *key, compare_triples);
  int32_t *cell = malloc((size_t)s->triangle_count * sizeof *cell);
  int32_t *patch = calloc((size_t)s->triangle_count, sizeof *patch);
  for (int32_t t = 0; t < s->triangle_count; t++) {
    const int32_t *p = s->triangle[t];
    int least = p[0] < p[1] ? (p[0] < p[2] ? 0 : 2) : (p[1] < p[2] ? 1 : 2);
    const int32_t wanted[3] = {p[least], p[(least + 1) % 3], p[(least + 2) % 3]};
    const int32_t *found = bsearch(wanted, key, (size_t)count, sizeof *key, compare_triples);
    assert_non_null(found);
    cell[t] = found[3];
  }
  CwRegionMesh region = {.domain = "rotor",
                         .region = 3,
                         .cells.point_count = fill->point_count,
                         .cells.points = fill->x,
                         .cells.tetrahedron_count = fill->tetrahedron_count,
                         .cells.tetrahedra = fill->tetrahedron,
                         .cells.triangle_count = s->triangle_count,
                         .cells.triangles = s->triangle,
                         .cells.triangle_patch = patch,
                         .cells.triangle_cell = cell};
  if (cw_audit_region(&region, &quality) != CW_OK) fail_msg("%s", cw_fail_message());
  double volume = surface_volume(s);
  assert_near(quality.volume, volume, 1e-12 * volume);
  assert_true(quality.dihedral_least >= 10.0);
  assert_true(quality.aspect_max <= 4.0);
  assert_true(quality.aspect_mean <= 1.55);
  free(key);
  free(cell);
  free(patch);
  return quality;
}

static CwQuality fill_and_check(const Surface *s, const Field *field) {
  CwFillInput input = input_of(s, field);
  CwFill fill;
  if (cw_tetgen_fill(&input, &fill) != CW_OK) fail_msg("%s", cw_fail_message());
  CwQuality quality = check_fill(s, &fill);
  cw_fill_free(&fill);
  return quality;
}

static const double origin[3] = {0, 0, 0};

static void cube(void **state) {
  Surface s = {0};
  surface_add_box(&s, (double[3]){0, 0, 0}, (double[3]){0.04, 0.04, 0.04}, (int[3]){12, 12, 12}, 1);
  assert_near(surface_volume(&s), 6.4e-5, 1e-18);
  CwQuality q = fill_and_check(&s, &(Field){.size = 0.04 / 12});
  // 6 sqrt(2) tetrahedra in h^3 for regular ones; right-angled triangles on the faces have longer edges than
  // h.
  double cells = 6.0 * sqrt(2.0) * 12 * 12 * 12;
  assert_true((double)q.cells > 0.8 * cells && (double)q.cells < 1.1 * cells);
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
  double volume = 0.0;
  for (int32_t t = 0; t < fill.tetrahedron_count; t++) {
    const double *x[4];
    for (int i = 0; i < 4; i++) x[i] = fill.x[fill.tetrahedron[t][i]];
    double six = cw_tet_volume6(x[0], x[1], x[2], x[3]);
    assert_true(six > 0.0);
    volume += six / 6.0;
  }
  assert_near(volume, 4e-7, 1e-18);
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
  check_fill(&s, &fill);
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
