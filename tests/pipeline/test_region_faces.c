// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/region_faces.h"

#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"
#include "tests/unit_test.h"

// A pyramid on the unit square with a tetrahedron at its side 1-2-4. Points 1, 2 and 4 are the shared ones
// (places 0, 1, 2), the others the region's own.
static double points[][3] = {{1, 0, 0}, {1, 1, 0}, {.5, .5, 1}, {0, 0, 0}, {0, 1, 0}, {2, .5, .5}};
static int64_t shared_id[] = {40, 20, 30};
static int32_t pyramids[][5] = {{3, 0, 1, 4, 2}};
static int32_t tetrahedra[][4] = {{0, 5, 1, 2}};
static const char name[] = "rotor-0001.h5";

typedef struct {
  int32_t triangles[8][3], triangle_patch[8], triangle_cell[8];
  int32_t quads[2][4], quad_patch[2], quad_cell[2];
  CwRegionData data;
} Region;

// With every outer face on a patch: three of the tetrahedron (cell 0), three triangles and the square of the
// pyramid.
static void make(Region *r) {
  static const int32_t triangles[6][3] = {{0, 1, 5}, {0, 5, 2}, {5, 1, 2}, {3, 0, 2}, {1, 4, 2}, {4, 3, 2}};
  memset(r, 0, sizeof *r);
  memcpy(r->triangles, triangles, sizeof triangles);
  for (int i = 0; i < 6; ++i) r->triangle_cell[i] = i >= 3;
  memcpy(r->quads[0], (int32_t[]){3, 4, 1, 0}, sizeof r->quads[0]);
  r->quad_cell[0] = 1;
  r->data = (CwRegionData){.points = points,
                           .point_count = 6,
                           .shared_count = 3,
                           .shared_id = shared_id,
                           .tetrahedra = tetrahedra,
                           .tetrahedron_count = 1,
                           .pyramids = pyramids,
                           .pyramid_count = 1,
                           .triangles = r->triangles,
                           .triangle_patch = r->triangle_patch,
                           .triangle_cell = r->triangle_cell,
                           .triangle_count = 6,
                           .quads = r->quads,
                           .quad_patch = r->quad_patch,
                           .quad_cell = r->quad_cell,
                           .quad_count = 1};
}

// Every way to match finds the fault.
static void fails_with(const Region *r, const char *words) {
  CwRegionFaces faces = {0};
  int32_t *open = NULL, count;
  assert_int_equal(cw_region_open_faces(name, CW_ERR_MESH, &r->data, 0, NULL, NULL, &open, &count), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), words));
  free(open);
  assert_int_equal(cw_region_faces(name, CW_ERR_INPUT, &r->data, &faces), CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), words) || !strstr(cw_fail_message(), "rotor-0001.h5: triangle of cell "))
    fail_msg("unexpected message: %s", cw_fail_message());
  cw_region_faces_free(&faces);
}

static void neighbours_find_each_other(void **state) {
  Region r;
  CwRegionFaces faces = {0};
  make(&r);
  assert_int_equal(cw_region_faces(name, CW_ERR_INPUT, &r.data, &faces), CW_OK);
  assert_int_equal(faces.inner_triangles, 1);
  assert_int_equal(faces.inner_quads, 0);
  assert_int_equal(faces.open_count, 0);
  int patch_faces = 0;
  for (int i = 0; i < 2 * CW_CELL_FACES; ++i) patch_faces += faces.across[i] == CW_ACROSS_PATCH;
  assert_int_equal(patch_faces, 7);
  assert_int_equal(faces.across[4], CW_ACROSS_NO_FACE); // a tetrahedron has four
  assert_int_equal(faces.quad_face[0], CW_CELL_FACES * 1 + 0);
  cw_region_faces_free(&faces);
}

// Without the tetrahedron the face 0-1-2 has shared points only: it waits for another region.
static void a_face_of_shared_points_stays_open(void **state) {
  Region r;
  CwRegionFaces faces = {0};
  int32_t *open = NULL, count = 0;
  make(&r);
  r.data.tetrahedron_count = 0;
  memmove(r.triangles, r.triangles + 3, 3 * sizeof *r.triangles);
  memset(r.triangle_cell, 0, sizeof r.triangle_cell);
  r.quad_cell[0] = 0;
  r.data.triangle_count = 3;
  assert_int_equal(cw_region_faces(name, CW_ERR_INPUT, &r.data, &faces), CW_OK);
  assert_int_equal(faces.open_count, 1);
  assert_int_equal(faces.across[2], CW_ACROSS_OPEN);
  cw_region_faces_free(&faces);
  for (int only_shared = 0; only_shared < 2; ++only_shared) {
    assert_int_equal(cw_region_open_faces(name, CW_ERR_INPUT, &r.data, only_shared, NULL, NULL, &open, &count), CW_OK);
    assert_int_equal(count, 1);
    assert_int_equal(open[0], 2);
    free(open);
  }
}

static void bad_surfaces_are_told(void **state) {
  Region r;
  make(&r);
  r.data.triangle_count = 5; // the last face of the pyramid, with own points
  fails_with(&r, "is open");
  make(&r);
  r.triangles[0][0] = 1;
  r.triangles[0][1] = 0;
  fails_with(&r, "with its normal into the domain");
  make(&r);
  r.triangle_cell[0] = 1;
  fails_with(&r, "with the wrong cell");
  make(&r);
  memcpy(r.triangles[6], r.triangles[0], sizeof *r.triangles);
  r.data.triangle_count = 7;
  fails_with(&r, "more than once");
  make(&r);
  memcpy(r.triangles[6], (int32_t[]){3, 4, 5}, sizeof *r.triangles);
  r.data.triangle_count = 7;
  fails_with(&r, "is no face of a cell");
}

static void two_cells_on_one_side_are_told(void **state) {
  Region r;
  int32_t twice[][4] = {{0, 5, 1, 2}, {0, 5, 1, 2}};
  make(&r);
  r.data.tetrahedra = twice;
  r.data.tetrahedron_count = 2;
  r.data.pyramid_count = 0;
  r.data.quad_count = r.data.triangle_count = 0;
  fails_with(&r, "has both of its cells on one side");
}

static void loops_do_not_depend_on_the_start(void **state) {
  const int64_t wanted[] = {2, 5, 9, 7};
  for (int start = 0; start < 4; ++start)
    for (int way = 0; way < 2; ++way) {
      int64_t nodes[4];
      int order[4];
      for (int i = 0; i < 4; ++i) nodes[i] = wanted[(start + (way ? 4 - i : i)) % 4];
      assert_int_equal(cw_face_loop(nodes, 4, order), way);
      for (int i = 0; i < 4; ++i) assert_int_equal(nodes[order[i]], wanted[i]);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(neighbours_find_each_other),
      cmocka_unit_test(a_face_of_shared_points_stays_open),
      cmocka_unit_test(bad_surfaces_are_told),
      cmocka_unit_test(two_cells_on_one_side_are_told),
      cmocka_unit_test(loops_do_not_depend_on_the_start),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
