// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_move.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/fill_mesh.h"
#include "mesher/policy.h"
#include "shaken_lattice.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static void set_qualities(CwTetWork *w) {
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    const int32_t *c = w->mesh->tet[t].corner;
    if (c[0] >= 0) w->mesh->tet[t].quality = cw_tet_quality_of(w, c[0], c[1], c[2], c[3]);
  }
}

static double least_at(const CwTetWork *w, int32_t point) {
  double least = INFINITY;
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    const int32_t *c = w->mesh->tet[t].corner;
    if (c[0] >= 0 && cw_tet_corner_of(&w->mesh->tet[t], point) >= 0)
      least = fmin(least, cw_tet_quality_of(w, c[0], c[1], c[2], c[3]));
  }
  return least;
}

// The eight tetrahedra of a regular octahedron, whose inner point (the last one) stands at x.
static CwTetMesh octahedron_round(const double x[3]) {
  static const double tip[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  double(*at)[3] = calloc(7, sizeof *at);
  int32_t(*tet)[4] = calloc(8, sizeof *tet);
  CwFill fill = {.point_count = 7, .x = at, .tetrahedron_count = 8, .tetrahedron = tet};
  CwTetMesh mesh;
  memcpy(at, tip, sizeof tip);
  memcpy(at[6], x, sizeof at[6]);
  for (int k = 0; k < 8; k++) {
    const int turned = (k & 1) ^ (k >> 1 & 1) ^ (k >> 2 & 1), y = k & 2 ? 4 : 1, z = k & 4 ? 5 : 2;
    memcpy(tet[k], (int32_t[4]){6, k & 1 ? 3 : 0, turned ? z : y, turned ? y : z}, sizeof *tet);
  }
  assert_int_equal(cw_fill_to_mesh(&fill, &mesh), CW_OK);
  cw_fill_free(&fill);
  return mesh;
}

// By symmetry the middle is best; a point that stands there stays, as does one that must not move.
static void a_point_goes_to_the_middle(void **state) {
  static const double start[3][3] = {{0.3, 0.2, 0.1}, {-0.1, 0.4, 0.2}, {0, 0, 0}};
  for (int k = 0; k < 6; k++) {
    CwTetMesh mesh = octahedron_round(start[k % 3]);
    CwTetWork w = {.mesh = &mesh, .fixed_count = k < 3 ? 6 : 7, .pass = 3};
    const int moves = k < 2;
    int done_it;
    set_qualities(&w);
    assert_int_equal(cw_tet_move_point(&w, 0, CW_ENCLOSING_POINTS + 6, &done_it), CW_OK);
    assert_int_equal(done_it, moves);
    assert_int_equal(w.count.points_moved, moves);
    for (int i = 0; i < 3; i++)
      assert_near(cw_tet_at(&w, CW_ENCLOSING_POINTS + 6)[i], moves ? 0 : start[k % 3][i], 1e-12);
    assert_near(joined_volume6(&mesh), 8, 1e-12);
    // All that touches the point is told to have changed in this pass, and has the quality it has now.
    for (int p = 0; p < 7; p++) assert_int_equal(mesh.point[CW_ENCLOSING_POINTS + p].mark, moves ? 3 : 0);
    for (int32_t t = 0; t < 8 && moves; t++)
      assert_near(mesh.tet[t].quality, sqrt(2.0 / 3.0), 1e-9); // of the corner of a cube
    // A corner of the octahedron is not moved, though that would gain.
    assert_int_equal(cw_tet_move_point(&w, 0, CW_ENCLOSING_POINTS, &done_it), CW_OK);
    assert_int_equal(done_it, 0);
    cw_tet_work_free(&w);
    cw_tet_mesh_free(&mesh);
  }
}

// Of a lattice that was shaken: a point is moved exactly where the least quality round it gains enough, and nothing
// else changes; those that fall below the limit are listed.
static void a_move_always_gains(void **state) {
  double(*x)[3];
  CwTetMesh mesh;
  int32_t outside, moved = 0, kept = 0;
  shaken_lattice(4, 0.35, &outside, &x, &mesh);
  CwTetWork w = {.mesh = &mesh, .fixed_count = outside, .limit = 0.4};
  CwTetList changed = {0};
  w.changed = &changed;
  set_qualities(&w);
  const double six = joined_volume6(&mesh);
  for (int32_t t = 0; t < mesh.tet_count; t++) {
    if (mesh.tet[t].corner[0] < 0) continue;
    for (int i = 0; i < 4; i++) {
      const int32_t p = mesh.tet[t].corner[i];
      const double before = least_at(&w, p);
      double was[3];
      int done_it;
      memcpy(was, cw_tet_at(&w, p), sizeof was);
      changed.count = 0;
      assert_int_equal(cw_tet_move_point(&w, t, p, &done_it), CW_OK);
      const double after = least_at(&w, p);
      if (mesh.source[p] < outside) assert_int_equal(done_it, 0);
      if (done_it) {
        assert_true(after > before + cw_policy.least_gain);
        for (int32_t k = 0; k < changed.count; k++) assert_true(cw_tet_corner_of(&mesh.tet[changed.tet[k]], p) >= 0);
        assert_true(changed.count >= 4);
      } else {
        assert_memory_equal(was, cw_tet_at(&w, p), sizeof was);
        assert_int_equal(changed.count, 0);
      }
      moved += done_it;
      kept += !done_it;
    }
  }
  assert_int_equal(w.count.points_moved, moved);
  assert_true(moved > 100 && kept > 100);
  assert_near(joined_volume6(&mesh) / six, 1, 1e-12);
  for (int32_t t = 0; t < mesh.tet_count; t++) {
    const int32_t *c = mesh.tet[t].corner;
    if (c[0] >= 0) assert_near(mesh.tet[t].quality, cw_tet_quality_of(&w, c[0], c[1], c[2], c[3]), 1e-15);
  }
  free(changed.tet);
  free(x);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_point_goes_to_the_middle),
      cmocka_unit_test(a_move_always_gains),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
