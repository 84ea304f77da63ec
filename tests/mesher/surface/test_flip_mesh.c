// SPDX-License-Identifier: AGPL-3.0-or-later
// Flips of edges, and what lies across them.
#include <stdlib.h>
#include <string.h>

#include "mesher/surface/flip_mesh.h"
#include "tests/unit_test.h"

// A square 0 1 2 3 of two triangles, and one more beside each of its sides, with the points 4 to 7:
//
//        6
//      .'4`.
//     3 --- 2
//   .'| 1 .'|`.
//  7 5| .' 0|2 4
//   `.|'    |.'
//     0 --- 1
//      `.3.'
//        5
enum { TRIANGLES = 6, POINTS = 8 };
static const int32_t square[TRIANGLES][3] = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {1, 0, 5}, {3, 2, 6}, {0, 3, 7}};
static const double place[POINTS][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0.5}, {0.5, -1}, {0.5, 2}, {-1, 0.5}};

static void begin(int32_t (*triangle)[3], CwFlipMesh *mesh) {
  memcpy(triangle, square, sizeof square);
  *mesh = (CwFlipMesh){triangle, NULL};
  assert_int_equal(cw_flip_neighbours(NULL, POINTS, TRIANGLES, NULL, mesh), CW_OK);
}

static void neighbours_by_hand(void **state) {
  const int32_t wanted[TRIANGLES][3] = {{3, 2, 1}, {0, 4, 5}, {-1, -1, 0}, {0, -1, -1}, {1, -1, -1}, {1, -1, -1}};
  int32_t triangle[TRIANGLES][3];
  CwFlipMesh mesh;
  begin(triangle, &mesh);
  assert_memory_equal(mesh.near, wanted, sizeof wanted);
  for (int32_t v = 0; v < 5; v++)
    assert_int_equal(cw_flip_corner(&mesh, 2, v), v == 1 ? 0 : v == 4 ? 1 : v == 2 ? 2 : -1);
  free(mesh.near);
}

// The diagonal 2 0 becomes 1 3: both triangles stay counter-clockwise, and all know their neighbours as if these were
// looked for anew.
static void a_flip_turns_the_diagonal(void **state) {
  int32_t triangle[TRIANGLES][3], wanted[2][3] = {{1, 3, 0}, {3, 1, 2}};
  CwFlipMesh mesh;
  begin(triangle, &mesh);
  cw_flip(&mesh, 0, 2, 1);
  assert_memory_equal(triangle, wanted, sizeof wanted);
  for (int t = 0; t < TRIANGLES; t++) {
    const double *a = place[triangle[t][0]], *b = place[triangle[t][1]], *c = place[triangle[t][2]];
    assert_true((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
  }
  CwFlipMesh again = {triangle, NULL};
  assert_int_equal(cw_flip_neighbours(NULL, POINTS, TRIANGLES, NULL, &again), CW_OK);
  assert_memory_equal(mesh.near, again.near, TRIANGLES * sizeof *again.near);
  free(mesh.near);
  free(again.near);
}

static void edges_round_a_corner(void **state) {
  int32_t triangle[TRIANGLES][3];
  CwFlipMesh mesh;
  begin(triangle, &mesh);
  assert_int_equal(cw_flip_joined(&mesh, 0, 0, 3), 1);
  assert_int_equal(cw_flip_joined(&mesh, 0, 1, 3), 0);
  assert_int_equal(cw_flip_joined(&mesh, 0, 2, 4), 1);
  assert_int_equal(cw_flip_joined(&mesh, 0, 2, 3), 1);
  assert_int_equal(cw_flip_joined(&mesh, 1, 0, 4), 0);
  free(mesh.near);
}

// Sides of three triangles, and two that run the same way, have nothing across them; nor have sides away from every
// triangle that may be flipped.
static void what_has_no_neighbour(void **state) {
  int32_t three[3][3] = {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, alike[2][3] = {{0, 1, 2}, {0, 1, 3}}, triangle[3][3];
  CwFlipMesh mesh = {three, NULL};
  assert_int_equal(cw_flip_neighbours(NULL, 5, 3, NULL, &mesh), CW_OK);
  for (int t = 0; t < 3; t++) assert_int_equal(mesh.near[t][0], -1);
  free(mesh.near);
  mesh = (CwFlipMesh){alike, NULL};
  assert_int_equal(cw_flip_neighbours(NULL, 4, 2, NULL, &mesh), CW_OK);
  for (int t = 0; t < 2; t++) assert_int_equal(mesh.near[t][0], -1);
  free(mesh.near);
  const int64_t none[3] = {-1, -1, -1}, last[3] = {-1, -1, 5};
  memcpy(triangle, square, sizeof triangle);
  mesh = (CwFlipMesh){triangle, NULL};
  assert_int_equal(cw_flip_neighbours(NULL, 5, 3, none, &mesh), CW_OK);
  for (int i = 0; i < 9; i++) assert_int_equal(mesh.near[i / 3][i % 3], -1);
  assert_int_equal(cw_flip_neighbours(NULL, 5, 3, last, &mesh), CW_OK); // brings them up to date
  assert_int_equal(mesh.near[2][2], 0);
  assert_int_equal(mesh.near[0][2], 1); // at point 2
  free(mesh.near);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(neighbours_by_hand),
      cmocka_unit_test(a_flip_turns_the_diagonal),
      cmocka_unit_test(edges_round_a_corner),
      cmocka_unit_test(what_has_no_neighbour),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
