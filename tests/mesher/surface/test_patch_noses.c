// SPDX-License-Identifier: AGPL-3.0-or-later
// Patches that turn so far that triangles from side to side stand upright on them.
#include <stdlib.h>

#include "mesher/surface/patch_delaunay.h"
#include "mesher/surface/patch_front.h"
#include "mesher/surface/patch_improve.h"
#include "patch_check.h"
#include "tests/unit_test.h"

// Half a cylinder of radius 0.1, from side to side (u = 0 and pi) by one chord and out to v = -0.12 and 0.12 on its
// back. The triangles over that chord are nearly equilateral, but hold it: they stand upright on both sides. Those
// along the back, which it is not divided by at first, lie at 45 degrees everywhere.
static void upright_triangles_are_flipped(void **state) {
  const double corner[4][2] = {{0, 0}, {M_PI / 2, -0.12}, {M_PI, 0}, {M_PI / 2, 0.12}};
  Plan *plan = new_plan(CYLINDER, 0.2);
  CwPatchWork work;
  for (int p = 0; p < 4; p++) add_point(plan, corner[p][0], corner[p][1]);
  add_outline(plan);
  CwCdt cdt;
  assert_int_equal(cw_cdt_make(&plan->input, (const double[2]){0.01, 1}, &cdt, &(CwOutcome){0}), CW_OK);
  assert_int_equal(cw_patch_work_open(&plan->input, &cdt, &work), CW_OK);
  cw_cdt_free(&cdt);
  int i = 0;
  while (work.given[0] >> i & 1) i++;
  assert_int_equal(work.corner[0][i] % 2, 1); // the edge across it is the chord
  assert_int_equal(cw_patch_delaunay(&work, 1), 0);
  assert_int_equal(cw_patch_improve(&work), CW_OK);
  assert_int_equal(check_patch(plan, &work, 0.5 * M_PI * 0.24), 2);
  assert_int_equal(work.point_count, 4);
  for (int t = 0; t < 2; t++) {
    const int32_t *c = work.corner[t];
    assert_true((c[0] == 1 || c[1] == 1 || c[2] == 1) && (c[0] == 3 || c[1] == 3 || c[2] == 3));
  }
  cw_patch_work_close(&work);
  free(plan);
}

// The greatest angle of a triangle, degrees.
static double greatest_angle(const CwPatchWork *work, const int32_t c[3]) {
  double greatest = 0;
  for (int i = 0; i < 3; i++) {
    const double *x = work->x[c[i]], *y = work->x[c[(i + 1) % 3]], *z = work->x[c[(i + 2) % 3]];
    double b = cw_patch_distance2(x, y), d = cw_patch_distance2(x, z), a = cw_patch_distance2(y, z);
    greatest = fmax(greatest, acos((b + d - a) / (2 * sqrt(b * d))) * 180 / M_PI);
  }
  return greatest;
}

// Half a cylinder of radius 0.1 with edges of ten radii along its sides, and two across each end: all triangles from
// side to side stand upright, and flips alone make fans of needles. Points between let them lie down, within
// 75 degrees, and none leads aslant over more than an edge and a half.
static void narrow_noses_are_divided(void **state) {
  enum { LONG = 8 };
  for (int i = 0; i < 10; i++) {
    Plan *plan = new_plan(CYLINDER, 1);
    CwPatchWork work;
    const double off = 0.05 * i; // of the points of one side to those of the other
    for (int k = 0; k <= LONG; k++) add_point(plan, 0, LONG - k + (k % LONG > 0 ? off : 0));
    add_point(plan, M_PI / 2, 0);
    for (int k = 0; k <= LONG; k++) add_point(plan, M_PI, k);
    add_point(plan, M_PI / 2, LONG);
    add_outline(plan);
    open_patch(plan, &work);
    cw_patch_delaunay(&work, 0);
    assert_int_equal(cw_patch_divide_noses(&work), CW_OK);
    assert_true(count_free_points(&work) >= LONG / 2);
    assert_int_equal(cw_patch_front(&work), CW_OK);
    assert_int_equal(cw_patch_improve(&work), CW_OK);
    check_patch(plan, &work, M_PI * LONG);
    double worst = 0;
    for (int32_t t = 0; t < work.triangle_count; t++) {
      if (work.corner[t][0] < 0) continue;
      const int32_t *c = work.corner[t];
      for (int k = 0; k < 3; k++) assert_true(cw_patch_distance2(work.x[c[k]], work.x[c[(k + 1) % 3]]) < 1.5 * 1.5);
      assert_true(cosine_on_cylinder(&work, c) > 0.25);
      worst = fmax(worst, greatest_angle(&work, c));
    }
    assert_true(worst < (i < 9 ? 165 : 173)); // at a half of an edge off none stands beside another
    cw_patch_work_close(&work);
    free(plan);
  }
}

// Where the wanted edges find room on it, rows of points come of themselves; nor is one of two diagonals of the same
// length turned into the other for ever.
static void wide_noses_are_not_divided(void **state) {
  for (int divided = 0; divided < 2; divided++) {
    Plan *plan = new_plan(CYLINDER, 0.1);
    CwPatchWork work;
    if (divided) {
      add_rectangle(plan, 0, 0, M_PI, 1);
    } else {
      for (int k = 0; k < 4; k++) add_point(plan, k % 3 ? M_PI : 0, k / 2);
      add_outline(plan);
    }
    open_patch(plan, &work);
    cw_patch_delaunay(&work, 0);
    assert_int_equal(cw_patch_divide_noses(&work), CW_OK);
    assert_int_equal(count_free_points(&work), 0);
    cw_patch_work_close(&work);
    free(plan);
  }
}

// Half a cylinder with three edges across each end and one along each side: no flip lays down all triangles across it,
// points have to go in. Then none stands at more than 60 degrees.
static void upright_triangles_are_divided(void **state) {
  for (int i = 0; i < 8; i++) {
    const double length = 0.2 + 0.1 * i;
    Plan *plan = new_plan(CYLINDER, 0.4);
    CwPatchWork work;
    for (int k = 0; k < 8; k++) add_point(plan, k < 4 ? k * M_PI / 3 : (7 - k) * M_PI / 3, k < 4 ? 0 : length);
    add_outline(plan);
    open_patch(plan, &work);
    assert_int_equal(cw_patch_improve(&work), CW_OK);
    check_patch(plan, &work, M_PI * length);
    for (int32_t t = 0; t < work.triangle_count; t++)
      if (work.corner[t][0] >= 0) assert_true(cosine_on_cylinder(&work, work.corner[t]) > 0.5);
    cw_patch_work_close(&work);
    free(plan);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(upright_triangles_are_flipped),
      cmocka_unit_test(narrow_noses_are_divided),
      cmocka_unit_test(wide_noses_are_not_divided),
      cmocka_unit_test(upright_triangles_are_divided),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
