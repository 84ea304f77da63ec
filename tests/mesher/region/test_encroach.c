// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/region/encroach.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static void flat_map(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]) {
  memcpy(x, (double[3]){uv[0], uv[1], 0}, sizeof(double[3]));
  if (xu) memcpy(xu, (double[3]){1, 0, 0}, sizeof(double[3]));
  if (xv) memcpy(xv, (double[3]){0, 1, 0}, sizeof(double[3]));
}

static double size_at(const void *context, const double x[3]) {
  const double *field = context; // size, growth along x
  return field[0] + field[1] * x[0];
}

static const double AXES[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const double ORIGIN[3] = {0, 0, 0};

// A rectangle of the given edges, each in `steps` parts.
typedef struct {
  double uv[400][2], x[400][3], field[2];
  int32_t edge[400][2];
  uint8_t boundary[400];
  CwPatchInput input;
} Rectangle;

static void rectangle(Rectangle *r, double width, double height, int steps, double size, double growth) {
  const double corner[5][2] = {{0, 0}, {width, 0}, {width, height}, {0, height}, {0, 0}};
  int count = 4 * steps;
  for (int k = 0; k < count; k++) {
    double s = (double)(k % steps) / steps;
    for (int i = 0; i < 2; i++)
      r->uv[k][i] = corner[k / steps][i] + s * (corner[k / steps + 1][i] - corner[k / steps][i]);
    flat_map(NULL, r->uv[k], r->x[k], NULL, NULL);
    r->edge[k][0] = k;
    r->edge[k][1] = (k + 1) % count;
    r->boundary[k] = 1;
  }
  r->field[0] = size;
  r->field[1] = growth;
  r->input = (CwPatchInput){.surface = flat_map,
                            .size = size_at,
                            .size_context = r->field,
                            .point_count = count,
                            .uv = (const double(*)[2])r->uv,
                            .x = (const double(*)[3])r->x,
                            .edge_count = count,
                            .edge = (const int32_t(*)[2])r->edge,
                            .boundary = r->boundary,
                            .name = "rectangle"};
}

static void circles_by_hand(void **unused) {
  double centre[2], radius;
  assert_true(cw_encroach_circle((double[2]){0, 0}, (double[2]){1, 0}, (double[2]){0, 1}, centre, &radius));
  assert_near(centre[0], 0.5, 1e-12);
  assert_near(centre[1], 0.5, 1e-12);
  assert_near(radius, sqrt(0.5), 1e-12);
  // A needle: its circle has a radius of 50.0025, its longest edge is 2.
  assert_true(cw_encroach_circle((double[2]){-1, 0}, (double[2]){1, 0}, (double[2]){0, 0.01}, centre, &radius));
  assert_near(centre[1], 0.005 - 50, 1e-12);
  assert_near(radius, 2, 1e-12);
  assert_false(cw_encroach_circle((double[2]){0, 0}, (double[2]){1, 1}, (double[2]){2, 2}, centre, &radius));
}

// A plane z = 2 with turned axes: candidates by height, and in a sphere.
static void candidates_beside_a_plane(void **unused) {
  const double axes[3][3] = {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}, origin[3] = {0, 0, 2};
  const double x[5][3] = {{0, 3, 2.5}, {0, 1, 1.9}, {1, 1, 2}, {0, 1, 2.8}, {0, 2, 1.5}};
  CwBeside beside;
  uint8_t mark[5] = {0};
  assert_int_equal(cw_beside_make(origin, axes, 0.6, 5, x, &beside), CW_OK);
  assert_int_equal(beside.count, 4);
  assert_int_equal(beside.candidate[0], 1); // u is y: 1, 1, 2, 3
  assert_int_equal(beside.candidate[1], 2);
  assert_int_equal(beside.candidate[2], 4);
  assert_int_equal(beside.candidate[3], 0);
  assert_near(beside.at[1][1], -1, 1e-12);
  assert_near(beside.at[0][2], -0.1, 1e-12);
  assert_int_equal(cw_beside_in_sphere(&beside, (double[2]){1.5, 0}, 0.75, mark), 2); // 1 and 4
  assert_true(!mark[0] && mark[1] && !mark[2] && !mark[3] && mark[4]);
  assert_int_equal(cw_beside_in_sphere(&beside, (double[2]){1.5, 0}, 0.5, NULL), 0);
  cw_beside_free(&beside);
}

// Two triangles of a square have one circle, of radius 0.707, about the middle.
static void a_square_gets_its_centre(void **unused) {
  Rectangle r;
  CwBeside beside;
  CwEncroachRefined refined;
  const double near[1][3] = {{0.4, 0.5, 0.1}}, far[1][3] = {{0.4, 0.5, 0.8}};
  rectangle(&r, 1, 1, 1, 0.5, 0);
  assert_int_equal(cw_beside_make(ORIGIN, AXES, 1, 1, far, &beside), CW_OK);
  assert_int_equal(cw_encroach_refine(&r.input, &beside, &refined), CW_OK);
  assert_int_equal(refined.point_count, 0);
  assert_int_equal(refined.triangle_count, 2);
  assert_int_equal(refined.encroached, 0);
  cw_encroach_refined_free(&refined);
  cw_beside_free(&beside);
  assert_int_equal(cw_beside_make(ORIGIN, AXES, 1, 1, near, &beside), CW_OK);
  assert_int_equal(cw_encroach_refine(&r.input, &beside, &refined), CW_OK);
  assert_int_equal(refined.encroached, 2);
  assert_int_equal(refined.point_count, 1);
  assert_near(refined.uv[0][0], 0.5, 1e-12);
  assert_near(refined.uv[0][1], 0.5, 1e-12);
  assert_int_equal(refined.triangle_count, 4);
  cw_encroach_refined_free(&refined);
  // Where edges of 1 are asked for (the centre is 0.707 from the corners, 0.5 from the edges) as well; not at 1.2.
  r.field[0] = 1;
  assert_int_equal(cw_encroach_refine(&r.input, &beside, &refined), CW_OK);
  assert_int_equal(refined.point_count, 1);
  cw_encroach_refined_free(&refined);
  r.field[0] = 1.2;
  assert_int_equal(cw_encroach_refine(&r.input, &beside, &refined), CW_OK);
  assert_int_equal(refined.point_count, 0);
  assert_int_equal(refined.left, 2);
  cw_encroach_refined_free(&refined);
  cw_beside_free(&beside);
}

// Many candidates over a graded rectangle that has points on its edges only: what is left encroached has no room, nodes
// keep their distance, the triangles cover the rectangle, and no circle has a node inside.
static void a_coarse_interface_is_refined(void **unused) {
  static Rectangle r;
  static double candidate[20000][3];
  CwBeside beside;
  CwEncroachRefined refined, again;
  uint64_t state = 7;
  rectangle(&r, 2, 1, 10, 0.05, 0.05);
  for (int k = 0; k < 60000; k++) candidate[k / 3][k % 3] = draw(&state) * (k % 3 == 0 ? 2 : k % 3 == 1 ? 1 : 0.2);
  assert_int_equal(cw_beside_make(ORIGIN, AXES, 0.5, 20000, (const double(*)[3])candidate, &beside), CW_OK);
  assert_int_equal(beside.count, 20000);
  assert_int_equal(cw_encroach_refine(&r.input, &beside, &refined), CW_OK);
  assert_int_equal(cw_encroach_refine(&r.input, &beside, &again), CW_OK);
  assert_int_equal(refined.point_count, again.point_count);
  assert_memory_equal(refined.uv, again.uv, (size_t)refined.point_count * sizeof *refined.uv);
  assert_memory_equal(refined.triangle, again.triangle, (size_t)refined.triangle_count * sizeof *refined.triangle);
  int count = 40 + refined.point_count;
  double(*uv)[2] = calloc((size_t)count, sizeof *uv), area = 0;
  memcpy(uv, r.uv, 40 * sizeof *uv);
  memcpy(uv + 40, refined.uv, (size_t)refined.point_count * sizeof *uv);
  assert_true(refined.point_count > 300);
  for (int p = 40; p < count; p++) {
    double h = r.field[0] + r.field[1] * uv[p][0];
    for (int q = 0; q < p; q++) assert_true(hypot(uv[p][0] - uv[q][0], uv[p][1] - uv[q][1]) > 0.62 * h - 1e-12);
  }
  int left = 0;
  for (int t = 0; t < refined.triangle_count; t++) {
    const double *a = uv[refined.triangle[t][0]], *b = uv[refined.triangle[t][1]], *c = uv[refined.triangle[t][2]];
    double centre[2], radius, twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    assert_true(twice > 0);
    area += twice / 2;
    assert_true(cw_encroach_circle(a, b, c, centre, &radius));
    double true_radius = hypot(centre[0] - a[0], centre[1] - a[1]), h = r.field[0] + r.field[1] * centre[0];
    for (int p = 0; p < count; p++) {
      assert_true(hypot(uv[p][0] - centre[0], uv[p][1] - centre[1]) > true_radius * (1 - 1e-9));
    }
    if (cw_beside_in_sphere(&beside, centre, radius, NULL) == 0) continue;
    left++;
    double edge = fmin(fmin(centre[0], 2 - centre[0]), fmin(centre[1], 1 - centre[1]));
    assert_true(true_radius < 0.62 * h + 1e-12 || edge < 0.5 * h + 1e-12);
  }
  assert_near(area, 2, 1e-12);
  assert_int_equal(left, refined.left);
  free(uv);
  cw_encroach_refined_free(&again);
  cw_encroach_refined_free(&refined);
  cw_beside_free(&beside);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(circles_by_hand),
      cmocka_unit_test(candidates_beside_a_plane),
      cmocka_unit_test(a_square_gets_its_centre),
      cmocka_unit_test(a_coarse_interface_is_refined),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
