// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/face_stretch.h"

#include <string.h>

#include "tests/unit_test.h"

// Two tetrahedra on the triangle 0-1-2; the lower one is cell 0 and has one more face, 1-0-3, on a partition plane.
static double points[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
static int64_t shared_id[] = {0, 1, 2, 3, 4};
static int32_t tetrahedra[2][4] = {{0, 2, 1, 3}, {0, 1, 2, 4}};
static int32_t triangles[][3] = {{2, 1, 3}, {0, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}};
static int32_t triangle_patch[] = {0, 1, 1, 1, 0}, triangle_cell[] = {0, 0, 1, 1, 1};
static CwModelPatch patches[2];
static CwMeshRegion line = {.path = "rotor-0001.h5"};
static CwMesh mesh = {.regions = &line,
                      .region_count = 1,
                      .patches = patches,
                      .patch_count = 2,
                      .domain_count = 1,
                      .domains = {{.patch_count = 2, .region_count = 1}}};
static CwRegionPlace place = {.cell = 100, .first_open = 1, .inner.triangles = 1, .outer.triangles = 1};
static CwPatchPart parts[] = {{.faces.triangles = 2}, {.faces.triangles = 3}};
static int64_t across[] = {0, 200};
static CwAssembly assembly = {
    .mesh = &mesh, .places = &place, .parts = parts, .patches = parts, .across = across, .open_count = 2};
static CwRegionData data = {.points = points,
                            .point_count = 5,
                            .shared_count = 5,
                            .shared_id = shared_id,
                            .tetrahedra = tetrahedra,
                            .tetrahedron_count = 2,
                            .triangles = triangles,
                            .triangle_patch = triangle_patch,
                            .triangle_cell = triangle_cell,
                            .triangle_count = 5};

// z of the normal by the right-hand rule of a triangle.
static double turn(const int32_t *n) {
  const double *a = points[n[0]], *b = points[n[1]], *c = points[n[2]];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static void inner_faces_go_by_the_cells(void **state) {
  CwRegionFaces faces = {0};
  CwFaceStretch s = {0};
  assert_int_equal(cw_region_faces("r", CW_ERR_INPUT, &data, &faces), CW_OK);
  assert_int_equal(cw_face_stretch_new(5, &s), CW_OK);
  assert_true(cw_face_stretch_inner(&assembly, 0, &data, &faces, &s));
  assert_int_equal(s.faces, 2);
  assert_int_equal(s.corners, 6);
  assert_int_equal(s.cell[0], 0);
  assert_int_equal(s.across[0], 101);
  assert_int_equal(s.open[0], -1);
  assert_true(turn(s.corner) > 0); // out of the lower cell
  assert_int_equal(s.cell[1], 0);
  assert_int_equal(s.across[1], 200); // of another region
  assert_int_equal(s.open[1], 1);
  assert_false(cw_face_stretch_inner(&assembly, 0, &data, &faces, &s));
  cw_face_stretch_start(&s);
  across[1] = 50; // that of the lower number has the face
  place.outer.triangles = 0;
  assert_true(cw_face_stretch_inner(&assembly, 0, &data, &faces, &s));
  assert_int_equal(s.faces, 1);
  cw_face_stretch_free(&s);
  cw_region_faces_free(&faces);
  across[1] = 200;
  place.outer.triangles = 1;
}

static void faces_on_a_patch_keep_their_order(void **state) {
  CwRegionFaces faces = {0};
  CwFaceStretch s = {0};
  assert_int_equal(cw_region_faces("r", CW_ERR_INPUT, &data, &faces), CW_OK);
  assert_int_equal(cw_face_stretch_new(2, &s), CW_OK);
  int before = 0; // faces given before: two at a time there is room for
  for (; cw_face_stretch_patch(&assembly, 1, &data, &faces, &s); before += (int)s.faces)
    for (int f = 0; f < s.faces; ++f) {
      assert_int_equal(s.cell[f], triangle_cell[before + f + 1]);
      assert_int_equal(s.across[f], -1);
      assert_int_equal(s.sides[f], 3);
      int found = 0;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) found += s.corner[3 * f + i] == triangles[before + f + 1][k];
      assert_int_equal(found, 3);
    }
  assert_int_equal(before, 3);
  cw_face_stretch_free(&s);
  cw_region_faces_free(&faces);
}

static void the_layout_counts_all_faces(void **state) {
  CwFaceLayout layout;
  mesh.domains[0].region_count = 1;
  assembly.totals[0] = (CwDomainTotal){.points = 5, .cells = 2};
  assert_int_equal(cw_face_layout_make(&assembly, &layout), CW_OK);
  assert_int_equal(layout.points, 5);
  assert_int_equal(layout.cells, 2);
  assert_int_equal(cw_face_count(layout.inner), 2);
  assert_int_equal(cw_face_count(layout.patch[1]), 4);
  assert_int_equal(cw_face_count(layout.all), 7);
  assert_int_equal(cw_corner_count(layout.all), 21);
  parts[1].before.triangles = 5; // those of regions before
  assert_int_equal(cw_face_layout_patch(&layout, &assembly, 0, 1).triangles, 9);
  parts[1].before.triangles = 0;
  cw_face_layout_free(&layout);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(inner_faces_go_by_the_cells),
      cmocka_unit_test(faces_on_a_patch_keep_their_order),
      cmocka_unit_test(the_layout_counts_all_faces),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
