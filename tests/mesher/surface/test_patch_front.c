// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_front.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/policy.h"
#include "mesher/surface/cdt.h"
#include "mesher/surface/patch_delaunay.h"
#include "patch_plan.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// What the patch mesher has when the fronts are through, before flips; `scale` brings u to lengths.
static void make_front(const Plan *plan, double scale, CwPatchWork *work) {
  CwCdt cdt;
  assert_int_equal(cw_cdt_make(&plan->input, (const double[2]){scale, 1}, &cdt, &(CwOutcome){0}), CW_OK);
  assert_int_equal(cw_patch_work_open(&plan->input, &cdt, work), CW_OK);
  cw_patch_delaunay(work, 0);
  assert_int_equal(cw_patch_front(work), CW_OK);
  cw_cdt_free(&cdt);
}

// Where equilateral triangles fit, the fronts meet in them: every point in its place, none lacks, none is too many.
static void a_lattice_is_filled_by_its_points(void **state) {
  const double h = 0.05;
  static const struct {
    int shape;
    double scale;
  } maps[] = {{PLANE, 1}, {STRETCHED, 0.02}};
  for (int m = 0; m < 2; m++)
    for (int n = 2; n <= 12; n += 5) {
      const double turned = 0.4 * n;
      Plan *plan = lattice_plan(maps[m].shape, n, h, maps[m].scale, turned);
      CwPatchWork work;
      int32_t triangles = 0, before = 0;
      make_front(plan, maps[m].scale, &work);
      assert_int_equal(work.point_count, 4 * n + (n - 1) * (n - 1));
      for (int32_t p = 4 * n; p < work.point_count; p++) {
        const double x = cos(turned) * work.x[p][0] + sin(turned) * work.x[p][1];
        const double y = -sin(turned) * work.x[p][0] + cos(turned) * work.x[p][1];
        const double b = y / (h * sqrt(0.75)), a = x / h - 0.5 * b;
        assert_near(a, rint(a), 1e-6);
        assert_near(b, rint(b), 1e-6);
        assert_near(work.size[p], h, 1e-12);
        // A row is whole before the next one starts.
        const int row = (int)rint(fmin(fmin(a, b), fmin(n - a, n - b)));
        assert_true(row >= before);
        before = row;
      }
      for (int32_t t = 0; t < work.triangle_count; t++) {
        const int32_t *c = work.corner[t];
        if (c[0] < 0) continue;
        triangles++;
        assert_near(cw_patch_quality(&work, c[0], c[1], c[2]), 1, 1e-6);
      }
      assert_int_equal(triangles, 2 * n * n);
      cw_patch_work_close(&work);
      free(plan);
    }
}

// The wanted length at a corner of a rectangle is the mean of its sides a and b, the circle has half the diagonal: with
// the share f^2 = (a^2 + b^2) / (a + b)^2 its triangles are just done. Shorter ones are left as they are; in a longer
// one an equilateral triangle on a short side would go far past the middle, and a point goes no further than 1.2 of the
// way.
static void what_is_done_gets_no_points(void **state) {
  const double f = cw_policy.front_done_radius * cw_policy.front_done_radius;
  const double ratio = (f + sqrt(2 * f - 1)) / (1 - f);
  for (int longer = 0; longer < 2; longer++) {
    const double half[2] = {0.5 * ratio * (longer ? 1.01 : 0.99), 0.5};
    Plan *plan = new_plan(PLANE, 0.9);
    CwPatchWork work;
    for (int k = 0; k < 4; k++) add_point(plan, k == 0 || k == 3 ? -half[0] : half[0], k < 2 ? -half[1] : half[1]);
    add_outline(plan);
    make_front(plan, 1, &work);
    assert_int_equal(work.point_count, 4 + longer);
    if (longer) assert_near(fabs(work.x[4][0]), 0.2 * half[0], 1e-12);
    if (longer) assert_near(work.x[4][1], 0, 1e-12);
    cw_patch_work_close(&work);
    free(plan);
  }
}

static double radius_of(const CwPatchWork *work, const int32_t c[3]) {
  const double a = cw_distance(work->x[c[1]], work->x[c[2]]), b = cw_distance(work->x[c[2]], work->x[c[0]]);
  const double d = cw_distance(work->x[c[0]], work->x[c[1]]);
  double n[3];
  cw_normal(work->x[c[0]], work->x[c[1]], work->x[c[2]], n);
  return a * b * d / (2 * cw_norm(n));
}

// Of random polygons, flat and on a cylinder, evenly and in a field that grows: no two points are nearer than allowed,
// no triangle far from the boundary is too large for its points, and the given points stay.
static void points_keep_their_distance(void **state) {
  uint64_t seed = 61;
  for (int round = 0; round < 24; round++) {
    const int on_cylinder = round % 2, corners = 3 + draw_below(&seed, 5);
    Plan *plan = new_plan(on_cylinder ? CYLINDER : PLANE, on_cylinder ? 0.008 : 0.05);
    const double scale = on_cylinder ? 0.1 : 1, radius = on_cylinder ? 0.1 : 0.7;
    double corner[8][2];
    CwPatchWork work;
    if (round % 4 == 0) plan->slope = 0.15;
    for (int k = 0; k < corners; k++) {
      const double angle = 2 * M_PI * (k + 0.4 * draw(&seed)) / corners;
      corner[k][0] = radius * cos(angle) / scale;
      corner[k][1] = radius * sin(angle);
    }
    add_loop(plan, corners, (const double(*)[2])corner);
    make_front(plan, scale, &work);
    assert_true(work.point_count > plan->input.point_count + 10);
    for (int32_t p = 0; p < work.point_count; p++) {
      if (p < plan->input.point_count) assert_memory_equal(work.x[p], plan->x[p], sizeof plan->x[p]);
      for (int32_t q = plan->input.point_count; q < p; q++)
        assert_true(cw_distance(work.x[p], work.x[q]) >
                    (cw_policy.least_distance - 1e-3) * fmin(work.size[p], work.size[q]));
    }
    for (int32_t t = 0; t < work.triangle_count; t++) {
      const int32_t *c = work.corner[t];
      if (c[0] < 0) continue;
      int inner = 1;
      for (int i = 0; i < 3; i++) inner &= c[i] >= plan->input.point_count;
      if (!inner) continue;
      const double over = radius_of(&work, c) / ((work.size[c[0]] + work.size[c[1]] + work.size[c[2]]) / 3);
      assert_true(over < 1.05 * cw_policy.front_done_radius);
    }
    cw_patch_work_close(&work);
    free(plan);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_lattice_is_filled_by_its_points),
      cmocka_unit_test(what_is_done_gets_no_points),
      cmocka_unit_test(points_keep_their_distance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
