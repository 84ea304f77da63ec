// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/fill_mesh.h"
#include "mesher/fill/tet_shorten.h"
#include "shaken_lattice.h"
#include "tet_sums.h"
#include "tests/unit_test.h"

static void release(CwTetWork *w, CwTetShapes *shapes) {
  cw_tet_shapes_free(shapes);
  cw_tet_work_free(w);
  cw_tet_mesh_free(w->mesh);
}

static void tetrahedra_become_less_slender(void **state) {
  double(*x)[3];
  CwTetMesh mesh;
  int32_t outside, count = shaken_lattice(8, 0.15, &outside, &x, &mesh);
  CwTetWork w = {.mesh = &mesh, .limit = 0.48, .fixed_count = outside, .source_count = count};
  CwTetShapes shapes = {.floor = 0.3};
  assert_int_equal(cw_tet_judge_all(&w, &shapes), CW_OK);
  TetSums before = tet_sums(&w, -1);
  assert_int_equal(cw_tet_shorten(&w, &shapes), CW_OK);
  TetSums after = tet_sums(&w, -1);
  assert_true(fabs(after.six / before.six - 1.0) < 1e-12);
  assert_true(after.least >= fmin(before.least, 0.3));
  assert_true(w.count.edges_removed > before.count / 50);
  assert_true(after.aspect < before.aspect - 0.005);
  assert_qualities_kept(&w);
  joined_volume6(&mesh);
  release(&w, &shapes);
  free(x);
}

// Tetrahedra round the edge from point 0 to point 1 (upright, of length 1), with `n` points round it in turn: after
// shortening, how many there are, and how many still have the edge.
static void shorten_round(int n, const double (*round)[2], int *count, int *with) {
  double x[6][3] = {{0, 0, 0.5}, {0, 0, -0.5}};
  int32_t tet[4][4];
  CwFill fill = {.point_count = 2 + n, .x = x, .tetrahedron_count = n, .tetrahedron = tet};
  CwTetMesh mesh = {0};
  for (int k = 0; k < n; k++) {
    memcpy(x[2 + k], round[k], sizeof *round);
    x[2 + k][2] = 0.0;
    memcpy(tet[k], (int32_t[4]){1, 0, 2 + k, 2 + (k + 1) % n}, sizeof *tet);
  }
  assert_int_equal(cw_fill_to_mesh(&fill, &mesh), CW_OK);
  CwTetWork w = {.mesh = &mesh, .fixed_count = 2 + n, .source_count = 2 + n};
  CwTetShapes shapes = {.floor = 0.3};
  assert_int_equal(cw_tet_judge_all(&w, &shapes), CW_OK);
  double six = tet_sums(&w, -1).six;
  assert_int_equal(cw_tet_shorten(&w, &shapes), CW_OK);
  TetSums after = tet_sums(&w, -1);
  assert_true(fabs(after.six / six - 1.0) < 1e-12);
  *count = after.count;
  *with = 0;
  for (int32_t t = 0; t < mesh.tet_count; t++) {
    int ends = 0;
    for (int i = 0; i < 4 && mesh.tet[t].corner[0] >= 0; i++) {
      int32_t source = mesh.source[mesh.tet[t].corner[i]];
      ends += source == 0 || source == 1;
    }
    *with += ends == 2;
  }
  release(&w, &shapes);
}

static void an_edge_goes_where_shorter_ones_come(void **state) {
  int count, with;
  shorten_round(3, (const double[3][2]){{0.33, 0}, {-0.165, 0.286}, {-0.165, -0.286}}, &count, &with);
  assert_int_equal(count, 2);
  assert_int_equal(with, 0);
  shorten_round(4, (const double[4][2]){{0.55, 0}, {0, 0.35}, {-0.55, 0}, {0, -0.35}}, &count, &with);
  assert_int_equal(count, 4); // round the edge of 0.7
  assert_int_equal(with, 0);
  shorten_round(4, (const double[4][2]){{0.85, 0}, {0, 0.6}, {-0.85, 0}, {0, -0.6}}, &count, &with);
  assert_int_equal(with, 4); // the others are longer
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(tetrahedra_become_less_slender),
      cmocka_unit_test(an_edge_goes_where_shorter_ones_come),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
