// SPDX-License-Identifier: AGPL-3.0-or-later
// Decimated surfaces: bounded, near the true one, edges kept, the same in any order (exact_sum); parts of the view.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/simplify.h"
#include "pipeline/report/view.h"
#include "tests/unit_test.h"

// Of the cube from 0 to 1, each side in side x side squares of two triangles, marked by side, every `step`th triangle
// from `first` on.
static void add_part(CwSimplifier *simplifier, int side, int64_t first, int64_t step) {
  const int64_t each = (int64_t)side * side * 2, all = 6 * each;
  for (int64_t n = 0, at = first; n < all / llabs(step); n++, at += step) {
    const int face = (int)(at / each), k = (int)(at % each);
    double x[3][3];
    const double *corner[3] = {x[0], x[1], x[2]}, value[CW_SIMPLIFY_VALUES] = {face, NAN};
    static const int step[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    for (int c = 0; c < 3; c++) {
      int square = k / 2;
      x[c][face % 3] = face / 3;
      x[c][(face + 1) % 3] = (square % side + step[k % 2][c][0]) / (double)side;
      x[c][(face + 2) % 3] = (square / side + step[k % 2][c][1]) / (double)side;
    }
    assert_int_equal(cw_simplify_add(simplifier, corner, face, value), CW_OK);
  }
}

static void add_cube(CwSimplifier *simplifier, int side) {
  add_part(simplifier, side, 0, 1);
}

static double area_of(const CwSimpleSurface *s) {
  double area = 0;
  for (int32_t t = 0; t < s->triangle_count; t++) {
    double u[3], v[3], n = 0;
    for (int i = 0; i < 3; i++) {
      u[i] = s->points[s->triangles[t][1]][i] - s->points[s->triangles[t][0]][i];
      v[i] = s->points[s->triangles[t][2]][i] - s->points[s->triangles[t][0]][i];
    }
    for (int i = 0; i < 3; i++) n += pow(u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3], 2);
    area += 0.5 * sqrt(n);
  }
  return area;
}

static void small_surfaces_stay_as_they_are(void **state) {
  CwSimplifier *simplifier;
  CwSimpleSurface surface = {0};
  assert_int_equal(cw_simplify_start(1000, 1e-4, &simplifier), CW_OK);
  add_cube(simplifier, 4);
  assert_int_equal(cw_simplify_finish(simplifier, &surface), CW_OK);
  assert_false(cw_simplify_coarsened(simplifier));
  assert_int_equal(surface.triangle_count, 192);
  assert_int_equal(surface.point_count, 98); // corners, edges and faces: 8 + 12 * 3 + 6 * 9
  assert_true(fabs(area_of(&surface) - 6) < 1e-9);
  cw_simple_surface_free(&surface);
  cw_simplify_free(simplifier);
}

static void large_surfaces_are_bounded_and_keep_their_edges(void **state) {
  CwSimpleSurface surface[2] = {{0}, {0}};
  for (int again = 0; again < 2; again++) {
    CwSimplifier *simplifier;
    assert_int_equal(cw_simplify_start(1500, 1e-4, &simplifier), CW_OK);
    add_cube(simplifier, 90); // 97200 triangles
    assert_int_equal(cw_simplify_finish(simplifier, &surface[again]), CW_OK);
    assert_true(cw_simplify_coarsened(simplifier));
    cw_simplify_free(simplifier);
  }
  const CwSimpleSurface *s = &surface[0];
  assert_in_range(s->triangle_count, 500, 1500);
  assert_int_equal(s->triangle_count, surface[1].triangle_count);
  assert_memory_equal(s->triangles, surface[1].triangles, (size_t)s->triangle_count * sizeof *s->triangles);
  assert_memory_equal(s->points, surface[1].points, (size_t)s->point_count * sizeof *s->points);
  // Points lie on the cube, where the planes of one, two or three sides meet.
  int sides[6] = {0}, corners = 0;
  for (int32_t p = 0; p < s->point_count; p++) {
    double off = 1;
    int on = 0;
    for (int i = 0; i < 3; i++) {
      double near = fmin(fabs(s->points[p][i]), fabs(s->points[p][i] - 1));
      off = fmin(off, near);
      on += near < 1e-3;
    }
    assert_true(off < 1e-3);
    corners += on == 3;
  }
  assert_int_equal(corners, 8);
  assert_true(fabs(area_of(s) / 6 - 1) < 0.01);
  for (int32_t p = 0; p < s->point_count; p++) { // means of what was given, and of nothing
    assert_true(s->values[p][0] >= 0 && s->values[p][0] <= 5 + 1e-9);
    assert_true(isnan(s->values[p][1]));
  }
  for (int32_t t = 0; t < s->triangle_count; t++) sides[s->mark[t]]++;
  for (int face = 0; face < 6; face++) assert_in_range(sides[face], 50, 400);
  for (int again = 0; again < 2; again++) cw_simple_surface_free(&surface[again]);
}

// From the first triangle to the last, the other way round, and in three simplifiers that hand theirs on.
static void no_order_and_no_division_counts(void **state) {
  enum { SIDE = 60, ALL = 12 * SIDE * SIDE };
  CwSimpleSurface surface[4] = {{0}};
  CwSimplifier *simplifier[4], *part[3];
  for (int k = 0; k < 4; k++) assert_int_equal(cw_simplify_start(1500, 1e-4, &simplifier[k]), CW_OK);
  add_part(simplifier[0], SIDE, 0, 1);
  add_part(simplifier[1], SIDE, ALL - 1, -1);
  for (int k = 0; k < 3; k++) {
    assert_int_equal(cw_simplify_start(1500, 1e-4, &part[k]), CW_OK);
    add_part(part[k], SIDE, k, 3);
  }
  for (int k = 0; k < 6; k++) { // into one that is empty, and into one that has some already
    void *bytes = NULL;
    int64_t size = 0;
    if (k == 0) add_part(simplifier[3], SIDE, 2, 3);
    if (k == 5) break;
    assert_int_equal(cw_simplify_pack(part[k % 3], &bytes, &size), CW_OK);
    assert_int_equal(cw_simplify_absorb(simplifier[2 + k / 3], bytes), CW_OK);
    free(bytes);
  }
  for (int k = 0; k < 4; k++) {
    const CwSimpleSurface *s = &surface[k];
    assert_int_equal(cw_simplify_finish(simplifier[k], &surface[k]), CW_OK);
    assert_int_equal(s->point_count, surface[0].point_count);
    assert_int_equal(s->triangle_count, surface[0].triangle_count);
    assert_memory_equal(s->points, surface[0].points, (size_t)s->point_count * sizeof *s->points);
    assert_memory_equal(s->triangles, surface[0].triangles, (size_t)s->triangle_count * sizeof *s->triangles);
    assert_memory_equal(s->mark, surface[0].mark, (size_t)s->triangle_count * sizeof *s->mark);
    for (int32_t p = 0; p < s->point_count; p++) assert_true(s->values[p][0] == surface[0].values[p][0]);
  }
  for (int k = 0; k < 4; k++) {
    cw_simple_surface_free(&surface[k]);
    cw_simplify_free(simplifier[k]);
    if (k < 3) cw_simplify_free(part[k]);
  }
}

// Two triangles of a wall, a quadrilateral of an outlet, a triangle of an interface, which is no part.
static void a_view_has_a_part_for_each_patch_but_interfaces(void **state) {
  double x[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}};
  int32_t triangle[][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}, triangle_patch[] = {0, 0, 2};
  int32_t quad[][4] = {{0, 1, 5, 4}}, quad_patch[] = {1};
  CwModelPatch names[] = {{.name = "hub", .kind = CW_PATCH_WALL},
                          {.name = "outlet", .kind = CW_PATCH_OUTLET},
                          {.name = "rotor_interface", .kind = CW_PATCH_INTERFACE},
                          {.name = "shroud", .kind = CW_PATCH_WALL}};
  CwModelInterface interface = {.patch = {2, 2}};
  CwMesh mesh = {.domain_count = 1, .patch_count = 4, .patches = names, .interface_count = 1, .interfaces = &interface};
  mesh.domains[0].patch_count = 4;
  mesh.domains[0].rotating = 1;
  CwRegionData cells = {.point_count = 6,
                        .triangle_count = 3,
                        .quad_count = 1,
                        .points = x,
                        .triangles = triangle,
                        .triangle_patch = triangle_patch,
                        .quads = quad,
                        .quad_patch = quad_patch};
  CwView view = {0};
  double *const share[CW_VIEW_QUANTITIES] = {(double[]){0, 1, 1, 1}, NULL};
  assert_int_equal(cw_view_start(&mesh, 1, &view), CW_OK);
  assert_int_equal(cw_view_add(&view, &mesh, &cells, share), CW_OK);
  assert_int_equal(cw_view_finish(&view, &mesh), CW_OK);
  assert_int_equal(view.part_count, 3);
  static const int patch[] = {0, 1, 3}, triangles[] = {2, 2, 0}, points[] = {4, 4, 0}, shown[] = {1, 0, 0};
  for (int k = 0; k < 3; k++) {
    assert_int_equal(view.part[k].patch, patch[k]);
    assert_int_equal(view.part[k].triangle_count, triangles[k]);
    assert_int_equal(view.part[k].point_count, points[k]);
    assert_int_equal(cw_view_shown(&mesh, &view.part[k]), shown[k]);
  }
  assert_false(view.decimated);
  // Means over the faces at each point, the interface's too; all of the same area.
  for (int k = 0; k < 4; k++) {
    const double *at = view.part[0].points[k];
    assert_int_equal(view.part[0].values[0][k], at[0] > 0.5 ? 128 : at[1] > 0.5 ? 255 : 204);
  }
  assert_null(view.part[0].values[1]);
  cw_view_free(&view);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(small_surfaces_stay_as_they_are),
      cmocka_unit_test(large_surfaces_are_bounded_and_keep_their_edges),
      cmocka_unit_test(no_order_and_no_division_counts),
      cmocka_unit_test(a_view_has_a_part_for_each_patch_but_interfaces),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
