// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/delaunay.h"
#include "mesher/fill/kernel_flips.h"
#include "mesher/fill/tet_improve.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static int never_in_the_way(const void *context, int count, const int32_t *point) {
  return 0;
}

// In the way: the edge or face that holds the two points of the context.
static int holds_both(const void *context, int count, const int32_t *point) {
  const int32_t *pair = context;
  int found = 0;
  for (int k = 0; k < count; k++) found += point[k] == pair[0] || point[k] == pair[1];
  return found == 2;
}

static int32_t point_from(const CwTetMesh *mesh, int32_t source) {
  for (int32_t p = 0; p < mesh->point_count; p++) {
    if (mesh->source[p] == source) return p;
  }
  return -1;
}

// A flat bipyramid over a triangle: Delaunay has the short axis 3-4; away with it, and back.
static void axis_of_a_bipyramid(void **unused) {
  const double x[5][3] = {{1, 0, 0}, {-0.5, 0.8, 0.01}, {-0.5, -0.8, 0}, {0.01, 0, 0.3}, {0, 0.01, -0.3}};
  CwTetMesh mesh;
  CwFlips flips;
  int32_t t, tet[CW_RING], ring[CW_RING];
  int flipped;
  assert_int_equal(cw_delaunay_make(5, x, &mesh), CW_OK);
  double six = joined_volume6(&mesh);
  assert_int_equal(cw_flips_make(&mesh, &flips), CW_OK);
  flips.crossing = never_in_the_way;
  flips.slack = 1;
  int32_t a = point_from(&mesh, 3), b = point_from(&mesh, 4);
  assert_int_equal(cw_flips_find_edge(&flips, a, b, &t), CW_OK);
  assert_true(t >= 0);
  assert_int_equal(cw_tet_ring(&mesh, t, a, b, CW_RING, tet, ring), 3);
  // Not where that is not wanted.
  const int32_t base[2] = {ring[0], ring[1]};
  flips.context = base;
  flips.crossing = holds_both;
  flips.slack = 0;
  assert_int_equal(cw_flips_edge(&flips, t, a, b, &flipped), CW_OK);
  assert_int_equal(flipped, 0);
  // The goal: the axis is in the way.
  const int32_t axis[2] = {a, b};
  flips.context = axis;
  assert_int_equal(cw_flips_edge(&flips, t, a, b, &flipped), CW_OK);
  assert_int_equal(flipped, 1);
  assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
  assert_int_equal(cw_flips_find_edge(&flips, a, b, &t), CW_OK);
  assert_int_equal(t, -1);
  // Back: the face between the two.
  flips.crossing = never_in_the_way;
  flips.slack = 1;
  flipped = 0;
  for (t = 0; t < mesh.tet_count && !flipped; t++) {
    for (int i = 0; i < 4 && !flipped && mesh.tet[t].corner[0] >= 0; i++) {
      int32_t other = mesh.tet[t].neighbour[i];
      if (other < 0 || mesh.tet[t].corner[i] != a || mesh.tet[other / 4].corner[other % 4] != b) continue;
      assert_int_equal(cw_flips_face(&flips, t, i, &flipped), CW_OK);
    }
  }
  assert_int_equal(flipped, 1);
  joined_volume6(&mesh);
  assert_int_equal(cw_flips_find_edge(&flips, a, b, &t), CW_OK);
  assert_true(t >= 0);
  cw_flips_free(&flips);
  cw_tet_mesh_free(&mesh);
}

// A point on the axis parts each of the three tetrahedra about it in two.
static void a_point_on_the_axis_of_a_bipyramid(void **unused) {
  const double x[5][3] = {{1, 0, 0}, {-0.5, 0.8, 0.01}, {-0.5, -0.8, 0}, {0.01, 0, 0.3}, {0, 0.01, -0.3}};
  CwTetMesh mesh;
  CwFlips flips;
  int32_t t, tet[CW_RING], ring[CW_RING], sources = 5;
  int split;
  assert_int_equal(cw_delaunay_make(5, x, &mesh), CW_OK);
  double six = joined_volume6(&mesh);
  assert_int_equal(cw_flips_make(&mesh, &flips), CW_OK);
  int32_t a = point_from(&mesh, 3), b = point_from(&mesh, 4);
  assert_int_equal(cw_flips_find_edge(&flips, a, b, &t), CW_OK);
  assert_int_equal(cw_flips_split(&flips, t, a, b, 0.25, &sources, &split), CW_OK);
  assert_int_equal(split, 1);
  assert_int_equal(sources, 6);
  int32_t made = point_from(&mesh, 5);
  for (int k = 0; k < 3; k++) assert_true(fabs(mesh.point[made].x[k] - (0.75 * x[3][k] + 0.25 * x[4][k])) < 1e-15);
  assert_int_equal(cw_flips_find_edge(&flips, a, b, &t), CW_OK);
  assert_int_equal(t, -1);
  for (int end = 0; end < 2; end++) {
    assert_int_equal(cw_flips_find_edge(&flips, made, end ? b : a, &t), CW_OK);
    assert_true(t >= 0);
    assert_int_equal(cw_tet_ring(&mesh, t, made, end ? b : a, CW_RING, tet, ring), 3);
  }
  assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
  cw_flips_free(&flips);
  cw_tet_mesh_free(&mesh);
}

static void any_flips_keep_a_mesh(void **unused) {
  double(*x)[3] = malloc(300 * sizeof *x);
  uint64_t state = 9;
  CwTetMesh mesh;
  CwFlips flips;
  int done = 0;
  for (int i = 0; i < 900; i++) x[i / 3][i % 3] = draw(&state);
  assert_int_equal(cw_delaunay_make(300, (const double(*)[3])x, &mesh), CW_OK);
  double six = joined_volume6(&mesh);
  assert_int_equal(cw_flips_make(&mesh, &flips), CW_OK);
  flips.crossing = never_in_the_way;
  flips.slack = 1;
  for (int k = 0; k < 4000; k++) {
    int32_t t = draw_below(&state, mesh.tet_count);
    int i = draw_below(&state, 4), j = (i + 1 + draw_below(&state, 3)) % 4, flipped = 0;
    if (mesh.tet[t].corner[0] < 0) continue;
    if (k % 2)
      assert_int_equal(cw_flips_face(&flips, t, i, &flipped), CW_OK);
    else
      assert_int_equal(cw_flips_edge(&flips, t, mesh.tet[t].corner[i], mesh.tet[t].corner[j], &flipped), CW_OK);
    done += flipped;
  }
  assert_true(done > 500);
  assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
  for (int32_t p = 0; p < mesh.point_count; p++) {
    const int32_t *c = mesh.tet[flips.tet_at[p]].corner;
    assert_true(c[0] == p || c[1] == p || c[2] == p || c[3] == p);
  }
  cw_flips_free(&flips);
  cw_tet_mesh_free(&mesh);
  free(x);
}

// Points of a shaken lattice: slivers go, points of the boundary (here: the first) stay, the volume is kept.
static void improvement_raises_the_least(void **unused) {
  double(*x)[3] = malloc(1000 * sizeof *x);
  uint64_t state = 4;
  CwTetMesh mesh;
  CwTetChanges changes;
  for (int i = 0; i < 3000; i++) {
    int k = i / 3;
    x[k][i % 3] = (i % 3 == 0 ? k % 10 : i % 3 == 1 ? k / 10 % 10 : k / 100) + 0.4 * draw(&state);
  }
  assert_int_equal(cw_delaunay_make(1000, (const double(*)[3])x, &mesh), CW_OK);
  double six = joined_volume6(&mesh);
  int32_t sources = 1000;
  assert_int_equal(cw_tet_improve_mesh(&mesh, 100, &sources, &changes), CW_OK);
  assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
  assert_true(changes.least_after > changes.least_before);
  assert_true(changes.edges_removed > 100 && changes.points_moved > 100);
  assert_int_equal(sources - 1000, changes.points_added);
  assert_int_equal(mesh.point_count, 1004 + changes.points_added);
  for (int32_t p = 0; p < mesh.point_count; p++) {
    if (mesh.source[p] >= 0 && mesh.source[p] < 100) assert_memory_equal(mesh.point[p].x, x[mesh.source[p]], sizeof *x);
  }
  cw_tet_mesh_free(&mesh);
  free(x);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(axis_of_a_bipyramid),
      cmocka_unit_test(a_point_on_the_axis_of_a_bipyramid),
      cmocka_unit_test(any_flips_keep_a_mesh),
      cmocka_unit_test(improvement_raises_the_least),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
