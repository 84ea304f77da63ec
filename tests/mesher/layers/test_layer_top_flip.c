// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>

#include "mesher/layers/layer_top_flip.h"
#include "tests/unit_test.h"

// A unit square in two triangles over edge 0-2, normal up; the fluid lies below.
static const double WALL[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const int64_t TOGETHER[2] = {5, 5}, APART[2] = {5, 6};

static void start(int32_t triangle[2][3]) {
  const int32_t given[2][3] = {{0, 1, 2}, {0, 2, 3}};
  for (int k = 0; k < 6; k++) triangle[k / 3][k % 3] = given[k / 3][k % 3];
}

static CwStatus flip(const double top[4][3], int32_t triangle[2][3], const int64_t *group, int32_t *flips) {
  CwFlipMesh mesh = {.triangle = triangle};
  assert_int_equal(cw_flip_neighbours(NULL, 4, 2, group, &mesh), CW_OK);
  CwStatus status = cw_layer_top_flip(NULL, WALL, top, 2, &mesh, group, flips);
  free(mesh.near);
  return status;
}

static int has_edge(int32_t (*triangle)[3], int32_t a, int32_t b) {
  int found = 0;
  for (int k = 0; k < 6; k++) found += triangle[k / 3][k % 3] == a && triangle[k / 3][(k + 1) % 3] == b;
  return found;
}

// The layer top is drawn out along the diagonal 0-2: least angle atan(0.3) there, 2 atan(0.3 / 1) across.
static void stretched_top_turns_its_diagonal(void **state) {
  const double top[4][3] = {{-0.5, -0.5, -1}, {0.65, 0.35, -1}, {1.5, 1.5, -1}, {0.35, 0.65, -1}};
  int32_t triangle[2][3], flips;
  start(triangle);
  assert_int_equal(flip(top, triangle, TOGETHER, &flips), CW_OK);
  assert_int_equal(flips, 1);
  assert_true(has_edge(triangle, 1, 3) && has_edge(triangle, 3, 1));
  assert_false(has_edge(triangle, 0, 2) || has_edge(triangle, 2, 0));
  for (int t = 0; t < 2; t++) { // still normal up
    const double *a = WALL[triangle[t][0]], *b = WALL[triangle[t][1]], *c = WALL[triangle[t][2]];
    assert_true((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
  }
}

static void even_top_and_borders_stay(void **state) {
  const double even[4][3] = {{0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}};
  const double drawn[4][3] = {{-0.5, -0.5, -1}, {0.65, 0.35, -1}, {1.5, 1.5, -1}, {0.35, 0.65, -1}};
  int32_t triangle[2][3], flips;
  start(triangle);
  assert_int_equal(flip(even, triangle, TOGETHER, &flips), CW_OK);
  assert_int_equal(flips, 0);
  assert_int_equal(flip(drawn, triangle, APART, &flips), CW_OK);
  assert_int_equal(flips, 0);
}

// A layer top bent along the diagonal keeps it: turning it would change the shape.
static void bent_top_stays(void **state) {
  const double bent[4][3] = {{-0.5, -0.5, -1}, {0.65, 0.35, -1.4}, {1.5, 1.5, -1}, {0.35, 0.65, -1.4}};
  int32_t triangle[2][3], flips;
  start(triangle);
  assert_int_equal(flip(bent, triangle, TOGETHER, &flips), CW_OK);
  assert_int_equal(flips, 0);
}

// Of a triangle from the law of cosines, degrees.
static double angles_least(const double a[3], const double b[3], const double c[3]) {
  const double *x[3] = {a, b, c};
  double least = 180;
  for (int k = 0; k < 3; k++) {
    const double *o = x[k], *p = x[(k + 1) % 3], *q = x[(k + 2) % 3];
    double op = hypot(p[0] - o[0], p[1] - o[1]), oq = hypot(q[0] - o[0], q[1] - o[1]);
    double pq = hypot(q[0] - p[0], q[1] - p[1]);
    least = fmin(least, acos((op * op + oq * oq - pq * pq) / (2 * op * oq)) * 180 / M_PI);
  }
  return least;
}

// Kites, long along the diagonal 0-2, whose least angle the diagonal 1-3 raises. With corner 0 near that diagonal it
// would leave a triangle with a twenty-fifth of the other's area.
static void no_small_triangle_beside_a_large_one(void **state) {
  for (int near = 0; near < 2; near++) {
    double corner = near ? 0 : -0.1;
    const double top[4][3] = {{corner, corner, -2}, {0.32, -0.08, -2}, {1.24, 1.24, -2}, {-0.26, 0.2, -2}};
    int32_t triangle[2][3], flips;
    double now = fmin(angles_least(top[0], top[1], top[2]), angles_least(top[0], top[2], top[3]));
    double then = fmin(angles_least(top[0], top[1], top[3]), angles_least(top[1], top[2], top[3]));
    print_message("  least angle %.1f, then %.1f degrees\n", now, then);
    assert_true(then > 1.1 * now);
    start(triangle);
    assert_int_equal(flip(top, triangle, TOGETHER, &flips), CW_OK);
    assert_int_equal(flips, !near);
  }
}

// Flat tops that are moved by up to a third of a side: a diagonal that gains much is turned, one that loses is not.
static void the_diagonal_of_the_larger_angles_is_taken(void **state) {
  int turned = 0, kept = 0;
  srand(1);
  for (int i = 0; i < 300; i++) {
    double top[4][3];
    int32_t triangle[2][3], flips;
    for (int k = 0; k < 8; k++) top[k / 2][k % 2] = WALL[k / 2][k % 2] + (rand() % 2001 - 1000) / 3000.0;
    for (int k = 0; k < 4; k++) top[k][2] = -1;
    double now = fmin(angles_least(top[0], top[1], top[2]), angles_least(top[0], top[2], top[3]));
    double then = fmin(angles_least(top[0], top[1], top[3]), angles_least(top[1], top[2], top[3]));
    start(triangle);
    assert_int_equal(flip(top, triangle, TOGETHER, &flips), CW_OK);
    if (then < now) assert_int_equal(flips, 0), kept++;
    if (then > 2 * now) assert_int_equal(flips, 1), turned++;
  }
  assert_true(turned > 5 && kept > 50);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stretched_top_turns_its_diagonal),
      cmocka_unit_test(even_top_and_borders_stay),
      cmocka_unit_test(bent_top_stays),
      cmocka_unit_test(no_small_triangle_beside_a_large_one),
      cmocka_unit_test(the_diagonal_of_the_larger_angles_is_taken),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
