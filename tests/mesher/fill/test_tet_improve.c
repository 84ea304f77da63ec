// SPDX-License-Identifier: AGPL-3.0-or-later

#include "closed_surfaces.h"
#include "mesher/fill/tet_improve.h"
#include "mesher/fill/tet_quality.h"
#include "tests/unit_test.h"

static CwFill fill_of(int32_t points, const double (*x)[3], int32_t tets, const int32_t (*tet)[4]) {
  CwFill fill = {.point_count = points, .tetrahedron_count = tets};
  fill.x = malloc((size_t)points * sizeof *fill.x);
  fill.tetrahedron = malloc((size_t)tets * sizeof *fill.tetrahedron);
  memcpy(fill.x, x, (size_t)points * sizeof *x);
  memcpy(fill.tetrahedron, tet, (size_t)tets * sizeof *tet);
  return fill;
}

static void free_fill(CwFill *fill) {
  free(fill->x);
  free(fill->tetrahedron);
}

static double least_of(const CwFill *fill, double *volume) {
  double least = INFINITY;
  *volume = 0.0;
  for (int32_t t = 0; t < fill->tetrahedron_count; t++) {
    const double *x[4];
    for (int i = 0; i < 4; i++) x[i] = fill->x[fill->tetrahedron[t][i]];
    *volume += cw_tet_volume6(x[0], x[1], x[2], x[3]) / 6.0;
    least = fmin(least, cw_tet_quality(x[0], x[1], x[2], x[3]));
  }
  return least;
}

static void quality_by_hand(void **state) {
  const double h = sqrt(0.75), a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0.5, h, 0};
  const double d[3] = {0.5, h / 3.0, sqrt(2.0 / 3.0)}, corner[3] = {0, 1, 0}, up[3] = {0, 0, 1};
  assert_near(cw_tet_quality(a, b, c, d), sqrt(8.0) / 3.0, 1e-14);       // sine of arccos(1/3)
  assert_near(cw_tet_quality(a, b, corner, up), sqrt(2.0 / 3.0), 1e-14); // sine of arctan(sqrt 2)
  assert_true(cw_tet_quality(b, a, c, d) <= 0.0);
  const double sine = sqrt(0.1786);              // what an aspect of 4 counts
  const double tall[3] = {0.5, h / 3.0, 3.0};    // longest edge over shortest sqrt(28 / 3), below 4
  const double far_up[3] = {0.5, h / 3.0, 12.0}; // sqrt(433 / 3), above 4: by the root
  assert_near(cw_tet_quality(a, b, c, tall), 4.0 * sine / sqrt(28.0 / 3.0), 1e-14);
  assert_near(cw_tet_quality(a, b, c, far_up), sine * sqrt(4.0 / sqrt(433.0 / 3.0)), 1e-14);
}

// An octahedron can be cut along each of its three diagonals; the boundary is the same. Started from the
// worst, the best is found.
static void octahedron_gets_its_best_diagonal(void **state) {
  const double x[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0.05, -1, 0}, {0, 1, 0.1}, {0, 0, -0.3}, {0, 0.02, 0.3}};
  double least[3], volume[3];
  int32_t tets[3][4][4];
  for (int axis = 0; axis < 3; axis++) {
    int a = 2 * axis, u = 2 * ((axis + 1) % 3), v = 2 * ((axis + 2) % 3);
    const int ring[4] = {u + 1, v + 1, u, v};
    for (int k = 0; k < 4; k++) {
      const int32_t one[4] = {a, a + 1, ring[k], ring[(k + 1) % 4]};
      memcpy(tets[axis][k], one, sizeof one);
    }
    CwFill fill = fill_of(6, x, 4, (const int32_t(*)[4])tets[axis]);
    least[axis] = least_of(&fill, &volume[axis]);
    free_fill(&fill);
  }
  int worst = least[0] < least[1] ? 0 : 1;
  if (least[2] < least[worst]) worst = 2;
  double best = fmax(fmax(least[0], least[1]), least[2]), got_volume;
  assert_true(least[worst] < 0.4 && best > least[worst] + 0.1);
  CwFill fill = fill_of(6, x, 4, (const int32_t(*)[4])tets[worst]);
  CwTetChanges changes;
  assert_int_equal(cw_tet_improve(6, &fill, &changes), CW_OK);
  assert_int_equal(changes.edges_removed, 1);
  assert_int_equal(fill.tetrahedron_count, 4);
  assert_near(least_of(&fill, &got_volume), best, 1e-14);
  assert_near(got_volume, volume[worst], 1e-14);
  assert_near(changes.least_before, least[worst], 1e-14);
  assert_true(best > 0.4226 && changes.least_after == 0.4226);
  free_fill(&fill);
}

// Two tall tetrahedra on a common flat face become three round the long axis, and back from three flat ones
// to two.
static void two_become_three_and_three_two(void **state) {
  const double h = sqrt(0.75);
  double x[5][3] = {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0.5, h / 3.0, 0.12}, {0.5, h / 3.0, -0.12}};
  const int32_t two[2][4] = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  const int32_t three[3][4] = {{0, 1, 4, 3}, {1, 2, 4, 3}, {2, 0, 4, 3}};
  double volume, least_two, least_three;
  CwFill fill = fill_of(5, x, 2, two);
  least_two = least_of(&fill, &volume);
  CwFill other = fill_of(5, x, 3, three);
  double other_volume;
  least_three = least_of(&other, &other_volume);
  assert_near(volume, other_volume, 1e-15);
  CwTetChanges changes;
  // Apexes close to one another: compare the two cuts and expect the better of them, from either side.
  double best = fmax(least_two, least_three);
  assert_int_equal(cw_tet_improve(5, &fill, &changes), CW_OK);
  assert_true(least_of(&fill, &volume) >= best - 1e-14); // a new point may go further
  assert_near(volume, other_volume, 1e-15);
  assert_int_equal(changes.faces_removed + changes.edges_removed, least_three > least_two);
  assert_int_equal(cw_tet_improve(5, &other, &changes), CW_OK);
  assert_true(least_of(&other, &volume) >= best - 1e-14);
  assert_near(volume, other_volume, 1e-15);
  assert_int_equal(changes.edges_removed + changes.faces_removed, least_two > least_three);
  free_fill(&fill);
  free_fill(&other);
  // Apexes far away: the face between them goes where its tetrahedra are the worse ones.
  x[3][2] = 0.1, x[4][2] = -0.7;
  fill = fill_of(5, x, 2, two);
  other = fill_of(5, x, 3, three);
  least_two = least_of(&fill, &volume);
  least_three = least_of(&other, &volume);
  assert_true(least_three > least_two);
  assert_int_equal(cw_tet_improve(5, &fill, &changes), CW_OK);
  assert_int_equal(changes.faces_removed, 1);
  assert_true(least_of(&fill, &volume) >= least_three - 1e-14);
  free_fill(&fill);
  free_fill(&other);
}

// An icosahedron's inner point, pushed against one face, comes back; the corners stay.
static void inner_point_is_smoothed(void **state) {
  Surface s = {0};
  double(*x)[3] = NULL, volume;
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 1.0, 0, 1);
  x = malloc(13 * sizeof *x);
  memcpy(x, s.x, 12 * sizeof *x);
  const int32_t *f = s.triangle[0];
  for (int i = 0; i < 3; i++) x[12][i] = 0.31 * (s.x[f[0]][i] + s.x[f[1]][i] + s.x[f[2]][i]);
  int32_t tet[20][4];
  for (int t = 0; t < 20; t++) {
    const int32_t one[4] = {s.triangle[t][0], s.triangle[t][2], s.triangle[t][1], 12};
    memcpy(tet[t], one, sizeof one);
  }
  CwFill fill = fill_of(13, (const double(*)[3])x, 20, (const int32_t(*)[4])tet);
  double before = least_of(&fill, &volume), whole = volume, enclosed = surface_volume(&s);
  assert_true(before > 0.0 && before < 0.2);
  assert_near(whole, enclosed, 1e-14);
  CwTetChanges changes;
  assert_int_equal(cw_tet_improve(12, &fill, &changes), CW_OK);
  assert_true(changes.points_moved + changes.edges_removed + changes.faces_removed > 0);
  assert_true(least_of(&fill, &volume) > 0.454);
  assert_near(volume, enclosed, 1e-14);
  assert_memory_equal(fill.x, x, 12 * sizeof *x);
  free_fill(&fill);
  free(x);
  surface_free(&s);
}

// A ball cut from one of its corners: flips alone cannot make it good, points inside can.
static void points_go_into_a_ball(void **state) {
  Surface s = {0};
  double volume;
  int32_t tet[75][4], count = 0;
  surface_add_sphere(&s, (double[3]){0, 0, 0}, 1.0, 1, 1);
  for (int t = 0; t < 80; t++) {
    const int32_t *f = s.triangle[t], one[4] = {f[0], f[2], f[1], 0};
    if (f[0] != 0 && f[1] != 0 && f[2] != 0) memcpy(tet[count++], one, sizeof one);
  }
  assert_int_equal(count, 75);
  CwFill fill = fill_of(42, (const double(*)[3])s.x, 75, (const int32_t(*)[4])tet);
  CwTetChanges changes;
  assert_true(least_of(&fill, &volume) < 0.4);
  assert_near(volume, surface_volume(&s), 1e-14);
  assert_int_equal(cw_tet_improve(42, &fill, &changes), CW_OK);
  assert_true(changes.points_added > 0 && fill.point_count > 42);
  assert_true(least_of(&fill, &volume) > 0.4226);
  assert_near(volume, surface_volume(&s), 1e-13);
  assert_memory_equal(fill.x, s.x, 42 * sizeof *fill.x);
  free_fill(&fill);
  surface_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(quality_by_hand),
      cmocka_unit_test(octahedron_gets_its_best_diagonal),
      cmocka_unit_test(two_become_three_and_three_two),
      cmocka_unit_test(inner_point_is_smoothed),
      cmocka_unit_test(points_go_into_a_ball),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
