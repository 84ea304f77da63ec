// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>

#include "mesher/layers/wall_unfold.h"
#include "tests/unit_test.h"

// A flat smoothing about point 0 in which point 5 has slipped past point 1: triangle 0-5-1 lies on its back.
static const double X[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0.6, 0.06, 0}};
static const int32_t SMOOTHING[5][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}};

static double up(const int32_t t[3]) {
  const double *a = X[t[0]], *b = X[t[1]], *c = X[t[2]];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static void copy_smoothing(int32_t (*triangle)[3]) {
  for (int k = 0; k < 15; k++) triangle[k / 3][k % 3] = SMOOTHING[k / 3][k % 3];
}

static CwStatus unfold(int32_t triangle[5][3], const int64_t *group, int32_t *flips, int32_t *folded) {
  CwFlipMesh mesh = {.triangle = triangle};
  assert_int_equal(cw_flip_neighbours(NULL, 6, 5, group, &mesh), CW_OK);
  CwStatus status = cw_wall_unfold(NULL, 6, X, 5, &mesh, group, flips, folded);
  free(mesh.near);
  return status;
}

static void a_fold_opens(void **state) {
  const int64_t group[5] = {1, 1, 1, 1, 1};
  int32_t triangle[5][3], flips, folded;
  copy_smoothing(triangle);
  assert_true(up(triangle[4]) < 0);
  assert_int_equal(unfold(triangle, group, &flips, &folded), CW_OK);
  assert_int_equal(flips, 1);
  assert_int_equal(folded, 0);
  double area = 0;
  for (int t = 0; t < 5; t++) {
    assert_true(up(triangle[t]) > 0);
    area += up(triangle[t]) / 2;
  }
  assert_true(fabs(area - 1.77) < 1e-12); // what the outline holds
}

static void borders_stay(void **state) {
  const int64_t group[5] = {1, 2, 3, 4, 5};
  int32_t triangle[5][3], flips, folded;
  copy_smoothing(triangle);
  assert_int_equal(unfold(triangle, group, &flips, &folded), CW_OK);
  assert_int_equal(flips, 0);
  assert_true(folded >= 1);
  for (int k = 0; k < 15; k++) assert_int_equal(triangle[k / 3][k % 3], SMOOTHING[k / 3][k % 3]);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_fold_opens), cmocka_unit_test(borders_stay)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
