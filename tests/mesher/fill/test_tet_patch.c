// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/tet_patch.h"
#include "shaken_lattice.h"
#include "tests/unit_test.h"

static int32_t used_count(const CwTetMesh *mesh) {
  int32_t count = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) count += mesh->tet[t].corner[0] >= 0;
  return count;
}

// A patch from the middle holds the nearest tetrahedra; points are free where all of their tetrahedra are in it and
// they are no boundary points. Put back with one point moved and one new in a tetrahedron, the whole is sound and has
// both.
static void patch_goes_out_and_back(void **state) {
  double(*x)[3];
  CwTetMesh whole;
  int32_t outside, count = shaken_lattice(8, 0.1, &outside, &x, &whole), middle = -1, *place = NULL;
  for (int32_t t = 0; t < whole.tet_count && middle < 0; t++) {
    int inner = whole.tet[t].corner[0] >= 0;
    for (int i = 0; i < 4 && inner; i++) {
      for (int a = 0; a < 3; a++) inner &= fabs(whole.point[whole.tet[t].corner[i]].x[a] - 4.0) < 1.5;
    }
    if (inner) middle = t;
  }
  assert_true(middle >= 0);
  double six = joined_volume6(&whole);
  int32_t before = used_count(&whole);
  CwTetPatch patch;
  assert_int_equal(cw_tet_patch_take(&whole, middle, 400, outside, &patch), CW_OK);
  assert_int_equal(patch.tet_count, 400);
  assert_int_equal(patch.mesh.tet_count, 400);
  assert_int_equal(patch.tet[0], middle);
  double taken = joined_volume6(&patch.mesh);
  assert_true(taken > 0.0 && taken < six);
  int32_t free_count = 0, moved = -1;
  for (int32_t p = 0; p < patch.point_count; p++) {
    int32_t all = 0, within = 0, old = patch.point[p];
    assert_memory_equal(patch.mesh.point[p].x, whole.point[old].x, sizeof *x);
    for (int32_t k = 0; k < 4 * whole.tet_count; k++)
      all += whole.tet[k / 4].corner[0] >= 0 && whole.tet[k / 4].corner[k % 4] == old;
    for (int32_t k = 0; k < 4 * patch.tet_count; k++) within += patch.mesh.tet[k / 4].corner[k % 4] == p;
    assert_int_equal(patch.mesh.source[p], all == within && whole.source[old] >= outside);
    if (patch.mesh.source[p]) free_count++, moved = p;
  }
  assert_true(free_count > 5);

  // Tetrahedron 0 becomes four round its middle.
  int32_t four[4], point;
  double centre[3] = {0, 0, 0};
  for (int i = 0; i < 12; i++) centre[i % 3] += 0.25 * patch.mesh.point[patch.mesh.tet[0].corner[i / 3]].x[i % 3];
  assert_int_equal(cw_tet_mesh_add_point(&patch.mesh, centre, 1, &point), CW_OK);
  four[0] = 0;
  for (int i = 1; i < 4; i++) assert_int_equal(cw_tet_mesh_new_tet(&patch.mesh, &four[i]), CW_OK);
  const CwTet old = patch.mesh.tet[0];
  for (int i = 0; i < 4; i++) {
    CwTet *tet = &patch.mesh.tet[four[i]];
    *tet = old;
    tet->corner[i] = point;
    for (int k = 0; k < 4; k++) tet->neighbour[k] = k == i ? old.neighbour[i] : 4 * four[k] + i;
    if (old.neighbour[i] >= 0) patch.mesh.tet[old.neighbour[i] / 4].neighbour[old.neighbour[i] % 4] = 4 * four[i] + i;
  }
  patch.mesh.point[moved].x[0] += 0.01;
  double there[3];
  memcpy(there, patch.mesh.point[moved].x, sizeof there);
  int32_t whole_point = patch.point[moved], sources = count, points = whole.point_count;
  assert_int_equal(cw_tet_patch_put(&patch, &whole, &sources, &place), CW_OK);
  assert_int_equal(used_count(&whole), before + 3);
  assert_true(fabs(joined_volume6(&whole) / six - 1.0) < 1e-12);
  assert_int_equal(sources, count + 1);
  assert_int_equal(whole.point_count, points + 1);
  assert_int_equal(whole.source[points], count);
  assert_memory_equal(whole.point[points].x, centre, sizeof centre);
  assert_memory_equal(whole.point[whole_point].x, there, sizeof there);
  for (int i = 0; i < 4; i++) assert_int_equal(whole.tet[place[four[i]]].corner[i], points);
  free(place);
  cw_tet_patch_free(&patch);
  cw_tet_mesh_free(&whole);
  free(x);
}

// One that lost a face of its hull is refused.
static void other_hull_is_refused(void **state) {
  double(*x)[3];
  CwTetMesh whole;
  CwTetPatch patch;
  int32_t outside, *place = NULL, sources = shaken_lattice(4, 0.1, &outside, &x, &whole);
  assert_int_equal(cw_tet_patch_take(&whole, whole.tet_count / 2, 20, outside, &patch), CW_OK);
  int32_t k = 0;
  while (patch.mesh.tet[k / 4].neighbour[k % 4] < 0) k++;
  patch.mesh.tet[k / 4].neighbour[k % 4] = -1; // a face inside stands open
  assert_int_equal(cw_tet_patch_put(&patch, &whole, &sources, &place), CW_ERR_FAULT);
  free(place);
  cw_tet_patch_free(&patch);
  cw_tet_mesh_free(&whole);
  free(x);
}

static int32_t beside_count(const CwTetMesh *mesh, int32_t beside) {
  int32_t count = 0;
  for (int32_t k = 0; k < 4 * mesh->tet_count; k++)
    count += mesh->tet[k / 4].corner[0] >= 0 && mesh->tet[k / 4].neighbour[k % 4] == beside;
  return count;
}

// Where the patch was cut out, there are others; where there is nothing beside the mesh, there is nothing beside the
// patch, nor beside what comes back.
static void nothing_beside_stays_nothing(void **state) {
  double(*x)[3];
  CwTetMesh whole;
  CwTetPatch patch;
  int32_t outside, sources = shaken_lattice(4, 0.1, &outside, &x, &whole), *place = NULL;
  for (int32_t k = 0; k < 4 * whole.tet_count; k++) {
    if (whole.tet[k / 4].corner[0] >= 0 && whole.tet[k / 4].neighbour[k % 4] < 0)
      whole.tet[k / 4].neighbour[k % 4] = CW_BESIDE_NOTHING;
  }
  assert_int_equal(beside_count(&whole, CW_BESIDE_NOTHING), 4); // the faces of the enclosing tetrahedron
  int32_t used = used_count(&whole), first = 0;
  while (whole.tet[first].corner[0] < 0) first++;
  assert_int_equal(cw_tet_patch_take(&whole, first, used, outside, &patch), CW_OK);
  assert_int_equal(patch.tet_count, used);
  assert_int_equal(beside_count(&patch.mesh, CW_BESIDE_NOTHING), 4);
  assert_int_equal(beside_count(&patch.mesh, CW_BESIDE_OTHERS), 0);
  assert_int_equal(cw_tet_patch_put(&patch, &whole, &sources, &place), CW_OK);
  assert_int_equal(beside_count(&whole, CW_BESIDE_NOTHING), 4);
  cw_tet_patch_free(&patch);
  free(place);
  while (whole.tet[first].corner[0] < 0) first++;
  assert_int_equal(cw_tet_patch_take(&whole, first, used / 2, outside, &patch), CW_OK);
  assert_true(beside_count(&patch.mesh, CW_BESIDE_OTHERS) > 0);
  cw_tet_patch_free(&patch);
  cw_tet_mesh_free(&whole);
  free(x);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nothing_beside_stays_nothing),
      cmocka_unit_test(patch_goes_out_and_back),
      cmocka_unit_test(other_hull_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
