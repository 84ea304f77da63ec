// SPDX-License-Identifier: AGPL-3.0-or-later
// The store of tetrahedra: free places, packing, room for points.
#include <string.h>

#include "mesher/fill/tet_mesh.h"
#include "tests/unit_test.h"

// Three in a row: 0 and 1 share face 0 of 0 and face 2 of 1; 1 and 2 face 0 of 1 and face 3 of 2.
static void make_row(CwTetMesh *mesh) {
  for (int32_t k = 0; k < 3; k++) {
    int32_t t;
    assert_int_equal(cw_tet_mesh_new_tet(mesh, &t), CW_OK);
    assert_int_equal(t, k);
    for (int i = 0; i < 4; i++) {
      mesh->tet[t].corner[i] = 10 * k + i;
      mesh->tet[t].neighbour[i] = CW_BESIDE_NOTHING;
    }
  }
  mesh->tet[0].neighbour[0] = 4 * 1 + 2;
  mesh->tet[1].neighbour[2] = 4 * 0 + 0;
  mesh->tet[1].neighbour[0] = 4 * 2 + 3;
  mesh->tet[2].neighbour[3] = 4 * 1 + 0;
}

static void places_are_used_again(void **state) {
  CwTetMesh mesh = {0};
  int32_t t;
  make_row(&mesh);
  assert_int_equal(cw_tet_corner_of(&mesh.tet[1], 12), 2);
  assert_int_equal(cw_tet_corner_of(&mesh.tet[1], 2), -1);
  cw_tet_mesh_free_tet(&mesh, 1);
  cw_tet_mesh_free_tet(&mesh, 0);
  const int32_t wanted[3] = {0, 1, 3}; // the last one freed comes first, then new places
  for (int k = 0; k < 3; k++) {
    assert_int_equal(cw_tet_mesh_new_tet(&mesh, &t), CW_OK);
    assert_int_equal(t, wanted[k]);
  }
  assert_int_equal(mesh.spare, 0);
  assert_int_equal(mesh.tet_count, 4);
  cw_tet_mesh_free(&mesh);
}

// Without the first, the second and the third move up, and know each other there.
static void packing_keeps_neighbours(void **state) {
  CwTetMesh mesh = {0};
  make_row(&mesh);
  mesh.tet[1].neighbour[2] = CW_BESIDE_OTHERS;
  cw_tet_mesh_free_tet(&mesh, 0);
  cw_tet_mesh_pack(&mesh);
  assert_int_equal(mesh.tet_count, 2);
  assert_int_equal(mesh.spare, 0);
  const int32_t wanted[2][4] = {{4 * 1 + 3, CW_BESIDE_NOTHING, CW_BESIDE_OTHERS, CW_BESIDE_NOTHING},
                                {CW_BESIDE_NOTHING, CW_BESIDE_NOTHING, CW_BESIDE_NOTHING, 4 * 0 + 0}};
  for (int32_t k = 0; k < 2; k++) {
    for (int i = 0; i < 4; i++) assert_int_equal(mesh.tet[k].corner[i], 10 * (k + 1) + i);
    assert_memory_equal(mesh.tet[k].neighbour, wanted[k], sizeof wanted[k]);
  }
  cw_tet_mesh_free(&mesh);
}

static void points_stay_while_their_number_grows(void **state) {
  CwTetMesh mesh = {0};
  for (int32_t p = 0; p < 1000; p++) {
    const double x[3] = {p, -p, 0.5 * p};
    int32_t number;
    assert_int_equal(cw_tet_mesh_add_point(&mesh, x, 3 * p, &number), CW_OK);
    assert_int_equal(number, p);
  }
  for (int32_t p = 0; p < 1000; p++) {
    assert_near(mesh.point[p].x[0], p, 0);
    assert_near(mesh.point[p].x[1], -p, 0);
    assert_near(mesh.point[p].x[2], 0.5 * p, 0);
    assert_int_equal(mesh.point[p].mark, 0);
    assert_int_equal(mesh.source[p], 3 * p);
  }
  cw_tet_mesh_free(&mesh);
}

static void too_many_are_refused(void **state) {
  CwTetMesh mesh = {0};
  assert_int_equal(cw_tet_mesh_make_room(&mesh, INT32_MAX / 4, 0), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "mesh.cells_per_region"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(places_are_used_again),
      cmocka_unit_test(packing_keeps_neighbours),
      cmocka_unit_test(points_stay_while_their_number_grows),
      cmocka_unit_test(too_many_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
