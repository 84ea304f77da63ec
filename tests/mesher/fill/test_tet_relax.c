// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>
#include <string.h>

#include "mesher/fill/tet_relax.h"
#include "mesher/policy.h"
#include "shaken_lattice.h"
#include "tet_sums.h"
#include "tests/unit_test.h"

// Relaxing is to follow: nothing is left worse below 0.3.
static CwTetWork work_on(CwTetMesh *mesh, int32_t outside, int32_t count, CwTetShapes *shapes) {
  CwTetWork w = {.mesh = mesh,
                 .limit = cw_policy.improve_below,
                 .fixed_count = outside,
                 .source_count = count,
                 .changed = &shapes->slender};
  *shapes = (CwTetShapes){.floor = 0.3, .irregular = calloc((size_t)mesh->point_count, 1)};
  assert_non_null(shapes->irregular);
  return w;
}

static const int moves = CW_TET_CENTRES | CW_TET_EDGES;

static void shaken_points_become_even(void **state) {
  double(*x)[3];
  CwTetMesh mesh;
  int32_t outside, count = shaken_lattice(8, 0.2, &outside, &x, &mesh), moved = 0;
  CwTetShapes shapes;
  CwTetWork w = work_on(&mesh, outside, count, &shapes);
  assert_int_equal(cw_tet_judge_all(&w, &shapes), CW_OK);
  TetSums before = tet_sums(&w, outside);
  assert_int_equal(cw_tet_relax(&w, &shapes, moves), CW_OK);
  TetSums after = tet_sums(&w, outside);
  assert_true(fabs(after.six / before.six - 1.0) < 1e-12);
  assert_true(after.quality > before.quality + 0.03);
  assert_true(before.aspect > 1.49 && after.aspect < 1.335); // 1.348 by the centres alone
  for (int32_t p = 0; p < mesh.point_count; p++) {
    if (mesh.source[p] < 0) continue;
    int same = memcmp(mesh.point[p].x, x[mesh.source[p]], sizeof *x) == 0;
    assert_true(same || mesh.source[p] >= outside);
    moved += !same;
  }
  assert_int_equal(moved, w.count.points_moved);
  assert_true(moved > (count - outside) / 2);
  assert_qualities_kept(&w);
  cw_tet_shapes_free(&shapes);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
  free(x);
}

// Two layers below the skin all tetrahedra are regular: their points stay to the bit.
static void lattice_stays(void **state) {
  double(*x)[3];
  CwTetMesh mesh;
  int32_t outside, count = shaken_lattice(8, 1e-3, &outside, &x, &mesh), deep = 0;
  CwTetShapes shapes;
  CwTetWork w = work_on(&mesh, outside, count, &shapes);
  assert_int_equal(cw_tet_judge_all(&w, &shapes), CW_OK);
  assert_int_equal(cw_tet_relax(&w, &shapes, moves), CW_OK);
  for (int32_t p = 0; p < mesh.point_count; p++) {
    if (mesh.source[p] < 0) continue;
    const double *old = x[mesh.source[p]];
    if (fmin(fmin(old[0], old[1]), old[2]) < 1.9 || fmax(fmax(old[0], old[1]), old[2]) > 6.1) continue;
    assert_memory_equal(mesh.point[p].x, old, sizeof *x);
    deep++;
  }
  assert_int_equal(deep, 5 * 5 * 5 + 4 * 4 * 4);
  cw_tet_shapes_free(&shapes);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
  free(x);
}

// Tetrahedra that come out below a floor and worse than they were, of some that the steps spoil.
static int spoilt_below(double floor) {
  double(*x)[3], *before;
  CwTetMesh mesh;
  int32_t outside, count = shaken_lattice(8, 0.25, &outside, &x, &mesh);
  int spoilt = 0;
  CwTetShapes shapes;
  CwTetWork w = work_on(&mesh, outside, count, &shapes);
  shapes.floor = floor;
  before = calloc((size_t)mesh.tet_count, sizeof *before);
  assert_non_null(before);
  assert_int_equal(cw_tet_judge_all(&w, &shapes), CW_OK);
  for (int32_t t = 0; t < mesh.tet_count; t++) before[t] = mesh.tet[t].quality;
  assert_int_equal(cw_tet_relax(&w, &shapes, CW_TET_EDGES), CW_OK);
  for (int32_t t = 0; t < mesh.tet_count; t++) {
    if (mesh.tet[t].corner[0] < 0) continue;
    spoilt += mesh.tet[t].quality < cw_policy.improve_below && mesh.tet[t].quality < before[t] - 1e-12;
  }
  cw_tet_shapes_free(&shapes);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
  free(before);
  free(x);
  return spoilt;
}

static void nothing_is_spoilt_below_the_floor(void **state) {
  assert_true(spoilt_below(0.0) > 10);
  assert_int_equal(spoilt_below(cw_policy.improve_below), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shaken_points_become_even),
      cmocka_unit_test(lattice_stays),
      cmocka_unit_test(nothing_is_spoilt_below_the_floor),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
