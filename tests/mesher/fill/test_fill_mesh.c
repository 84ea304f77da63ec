// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/delaunay.h"
#include "mesher/fill/fill_mesh.h"
#include "shaken_lattice.h"
#include "tests/unit_test.h"

// The inside of a Delaunay mesh as a fill, as a mesh, and as a fill again: all neighbours know one another, and points
// and tetrahedra come back as they were.
static void there_and_back(void **unused) {
  double(*x)[3];
  CwTetMesh whole, mesh;
  int32_t outside, count = shaken_lattice(5, 0.2, &outside, &x, &whole), kept = 0;
  CwFill fill = {.point_count = count, .x = x}, back = {0};
  fill.tetrahedron = calloc((size_t)whole.tet_count, sizeof *fill.tetrahedron);
  for (int32_t t = 0; t < whole.tet_count; t++) {
    int inside = whole.tet[t].corner[0] >= 0;
    for (int i = 0; i < 4 && inside; i++) inside = whole.tet[t].corner[i] >= CW_ENCLOSING_POINTS;
    for (int i = 0; i < 4 && inside; i++) fill.tetrahedron[kept][i] = whole.source[whole.tet[t].corner[i]];
    kept += inside;
  }
  fill.tetrahedron_count = kept;
  assert_int_equal(cw_fill_to_mesh(&fill, &mesh), CW_OK);
  assert_true(joined_volume6(&mesh) > 0.0);
  assert_int_equal(mesh.tet_count, kept);
  assert_int_equal(cw_fill_from_mesh(&mesh, outside, count, &back), CW_OK);
  assert_int_equal(back.point_count, count);
  assert_int_equal(back.tetrahedron_count, kept);
  assert_memory_equal(back.x, fill.x, (size_t)count * sizeof *fill.x);
  assert_memory_equal(back.tetrahedron, fill.tetrahedron, (size_t)kept * sizeof *fill.tetrahedron);
  cw_tet_mesh_free(&mesh);
  cw_tet_mesh_free(&whole);
  cw_fill_free(&back);
  cw_fill_free(&fill);
}

// Of three points only those of the boundary stay where no tetrahedron has them.
static void points_without_tetrahedra_go(void **unused) {
  static double x[7][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}, {8, 8, 8}, {0, 0, 1}, {7, 7, 7}};
  static int32_t tet[1][4] = {{0, 1, 2, 5}};
  const CwFill fill = {.point_count = 7, .x = x, .tetrahedron_count = 1, .tetrahedron = tet};
  CwFill back = {0};
  CwTetMesh mesh;
  assert_int_equal(cw_fill_to_mesh(&fill, &mesh), CW_OK);
  assert_int_equal(cw_fill_from_mesh(&mesh, 4, 7, &back), CW_OK);
  assert_int_equal(back.point_count, 5);
  assert_memory_equal(back.x[3], x[3], sizeof *x);
  assert_memory_equal(back.x[4], x[5], sizeof *x);
  assert_int_equal(back.tetrahedron[0][3], 4);
  cw_tet_mesh_free(&mesh);
  cw_fill_free(&back);
}

// Of no tetrahedra the boundary's points stay, and the fill can be freed.
static void without_tetrahedra(void **unused) {
  static double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const CwFill fill = {.point_count = 3, .x = x};
  CwFill back = {0};
  CwTetMesh mesh;
  assert_int_equal(cw_fill_to_mesh(&fill, &mesh), CW_OK);
  assert_int_equal(cw_fill_from_mesh(&mesh, 2, 3, &back), CW_OK);
  assert_int_equal(back.tetrahedron_count, 0);
  assert_int_equal(back.point_count, 2);
  assert_memory_equal(back.x, x, 2 * sizeof *x);
  cw_tet_mesh_free(&mesh);
  cw_fill_free(&back);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(there_and_back), cmocka_unit_test(points_without_tetrahedra_go),
                                     cmocka_unit_test(without_tetrahedra)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
