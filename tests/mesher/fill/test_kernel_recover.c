// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fill_fault.h"
#include "joined_mesh.h"
#include "mesher/fill/delaunay.h"
#include "mesher/fill/kernel_recover.h"
#include "surface_shapes.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static const double origin[3] = {0, 0, 0};

static int same_three(const int32_t a[3], const int32_t b[3]) {
  int same = 0;
  for (int k = 0; k < 9; k++) same += a[k / 3] == b[k % 3];
  return same == 3;
}

// Whether some tetrahedron has the three points.
static int has_face(const CwTetMesh *mesh, const int32_t p[3]) {
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    for (int i = 0; i < 4 && mesh->tet[t].corner[0] >= 0; i++) {
      int32_t face[3];
      for (int k = 0; k < 3; k++) face[k] = mesh->tet[t].corner[cw_tet_face[i][k]];
      if (same_three(face, p)) return 1;
    }
  }
  return 0;
}

// Tables against lists: faces in any order, edges in both directions, and those that are none.
static void facets_and_edges_are_found(void **unused) {
  Surface s = {0};
  double size = 1.0;
  CwTetMesh mesh;
  CwFacets facets;
  uint64_t state = 3;
  surface_add_sphere(&s, origin, 0.05, 2, 1);
  CwFillInput input = fill_input(&s, &size);
  assert_int_equal(cw_delaunay_make(s.point_count, (const double(*)[3])s.x, &mesh), CW_OK);
  assert_int_equal(cw_facets_make(&input, &mesh, &facets), CW_OK);
  assert_int_equal(facets.count, s.triangle_count);
  for (int32_t f = 0; f < facets.count; f++) {
    const int32_t *p = facets.corner[f], turned[3] = {p[1], p[0], p[2]};
    assert_int_equal(cw_facets_find(&facets, turned), f);
    for (int k = 0; k < 3; k++) assert_true(cw_facets_has_edge(&facets, p[(k + 1) % 3], p[k]));
  }
  for (int k = 0; k < 2000; k++) {
    int32_t p[3], found = -1, edge = 0;
    for (int i = 0; i < 3; i++) p[i] = CW_ENCLOSING_POINTS + draw_below(&state, s.point_count);
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    for (int32_t f = 0; f < facets.count; f++) {
      int both = 0;
      if (same_three(facets.corner[f], p)) found = f;
      for (int i = 0; i < 3; i++) both += facets.corner[f][i] == p[0] || facets.corner[f][i] == p[1];
      edge |= both == 2;
    }
    assert_int_equal(cw_facets_find(&facets, p), found);
    assert_int_equal(cw_facets_has_edge(&facets, p[0], p[1]), edge);
  }
  cw_facets_free(&facets);
  cw_tet_mesh_free(&mesh);
  surface_free(&s);
}

static void a_triangle_listed_twice_is_refused(void **unused) {
  Surface s = {0};
  double size = 1.0;
  CwTetMesh mesh;
  CwFacets facets;
  surface_add_sphere(&s, origin, 0.05, 1, 1);
  memcpy(s.triangle[1], (int32_t[3]){s.triangle[0][1], s.triangle[0][0], s.triangle[0][2]}, sizeof *s.triangle);
  CwFillInput input = fill_input(&s, &size);
  assert_int_equal(cw_delaunay_make(s.point_count, (const double(*)[3])s.x, &mesh), CW_OK);
  assert_int_equal(cw_facets_make(&input, &mesh, &facets), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "is listed twice"));
  cw_facets_free(&facets);
  cw_tet_mesh_free(&mesh);
  surface_free(&s);
}

static int has_edge(const CwTetMesh *mesh, int32_t a, int32_t b) {
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *corner = mesh->tet[t].corner;
    int both = 0;
    for (int i = 0; i < 4; i++) both += corner[i] == a || corner[i] == b;
    if (corner[0] >= 0 && both == 2) return 1;
  }
  return 0;
}

// Wrong diagonals on a sphere without inner points: some facets are missing, by the list of all faces too; flips bring
// most in, and the mesh stays one of the same volume.
static void missing_facets_are_recovered(void **unused) {
  for (uint32_t seed = 1; seed <= 3; seed++) {
    Surface s = {0};
    double size = 1.0;
    CwTetMesh mesh;
    CwFacets facets;
    int64_t flips = 0;
    int32_t missing = 0, sources = 0;
    surface_add_sphere(&s, origin, 0.05, 3, 1);
    assert_true(shape_turn_diagonals(&s, seed, 20) > 10);
    CwFillInput input = fill_input(&s, &size);
    assert_int_equal(cw_delaunay_make(s.point_count, (const double(*)[3])s.x, &mesh), CW_OK);
    assert_int_equal(cw_facets_make(&input, &mesh, &facets), CW_OK);
    assert_int_equal(cw_facets_locate(&mesh, s.point_count, &facets), CW_OK);
    for (int32_t f = 0; f < facets.count; f++) missing += !has_face(&mesh, facets.corner[f]);
    assert_int_equal(facets.missing_count, missing);
    assert_true(missing > 0);
    sources = s.point_count;
    double six = joined_volume6(&mesh);
    for (int round = 0; round < 4 && facets.missing_count; round++)
      assert_int_equal(cw_kernel_recover(&mesh, &facets, round, NULL, &sources, &flips), CW_OK);
    assert_true(4 * facets.missing_count < missing);
    assert_true(flips >= (missing - facets.missing_count) / 2);
    // What stays missing lacks an edge: nothing else keeps a face away.
    int32_t closed = 0;
    for (int32_t f = 0; f < facets.count; f++) {
      const int32_t *c = facets.corner[f];
      closed += !has_face(&mesh, c) && has_edge(&mesh, c[0], c[1]) && has_edge(&mesh, c[1], c[2]) &&
                has_edge(&mesh, c[2], c[0]);
    }
    assert_int_equal(closed, 0);
    for (int32_t f = 0, left = 0; f < facets.count; f++) {
      left += !has_face(&mesh, facets.corner[f]);
      if (f + 1 == facets.count) assert_int_equal(left, facets.missing_count);
      if (facets.inner[f] < 0) continue;
      const CwTet *tet = &mesh.tet[facets.inner[f] / 4]; // its fourth corner lies inside
      const double *x[3], *apex = mesh.point[tet->corner[facets.inner[f] % 4]].x;
      for (int k = 0; k < 3; k++) x[k] = mesh.point[facets.corner[f][k]].x;
      assert_true(cw_orient3d(x[0], x[1], x[2], apex) < 0);
    }
    assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
    cw_facets_free(&facets);
    cw_tet_mesh_free(&mesh);
    surface_free(&s);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(facets_and_edges_are_found),
      cmocka_unit_test(a_triangle_listed_twice_is_refused),
      cmocka_unit_test(missing_facets_are_recovered),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
