// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "mesher/layers/layer_top_flip.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stretched_top_turns_its_diagonal),
      cmocka_unit_test(even_top_and_borders_stay),
      cmocka_unit_test(bent_top_stays),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
