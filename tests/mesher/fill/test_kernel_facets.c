// SPDX-License-Identifier: AGPL-3.0-or-later
// Boundary triangles in a mesh of two tetrahedra: found by their points, and seen from inside.
#include <string.h>

#include "mesher/fill/kernel_facets.h"
#include "two_tets.h"

// The mesh numbers the points otherwise: point p is the given point of[p].
static const int32_t of[5] = {2, 0, 3, 1, 4}, number[5] = {1, 3, 0, 2, 4};

typedef struct {
  CwTet tet[2];
  CwTetPoint point[5];
  int32_t source[5];
  CwTetMesh mesh;
} Two;

static void make(Two *two) {
  memset(two, 0, sizeof *two);
  for (int p = 0; p < 5; p++) {
    memcpy(two->point[p].x, two_x[of[p]], sizeof two_x[0]);
    two->source[p] = of[p];
  }
  for (int t = 0; t < 2; t++) {
    for (int i = 0; i < 4; i++) {
      two->tet[t].corner[i] = number[two_tets[t][i]];
      two->tet[t].neighbour[i] = CW_BESIDE_OTHERS;
    }
  }
  two->tet[0].neighbour[3] = 4 * 1 + 3;
  two->tet[1].neighbour[3] = 4 * 0 + 3;
  two->mesh =
      (CwTetMesh){.point_count = 5, .point = two->point, .source = two->source, .tet_count = 2, .tet = two->tet};
}

static void facets_are_found_by_their_points(void **state) {
  Two two;
  CwFacets facets;
  int32_t triangle[4][3];
  make(&two);
  const CwFillInput input = two_boundary(triangle, 0);
  assert_int_equal(cw_facets_make(&input, &two.mesh, &facets), CW_OK);
  assert_int_equal(facets.count, 4);
  for (int f = 0; f < 4; f++) {
    const int32_t *p = facets.corner[f], any[2][3] = {{p[2], p[0], p[1]}, {p[1], p[0], p[2]}};
    for (int k = 0; k < 3; k++) assert_int_equal(p[k], number[triangle[f][k]]);
    for (int i = 0; i < 2; i++) assert_int_equal(cw_facets_find(&facets, any[i]), f);
  }
  const int32_t below[3] = {number[0], number[1], number[4]};
  assert_int_equal(cw_facets_find(&facets, below), -1);
  for (int a = 0; a < 5; a++) {
    for (int b = 0; b < 5; b++) {
      if (a != b) assert_int_equal(cw_facets_has_edge(&facets, number[a], number[b]), a < 4 && b < 4);
    }
  }
  cw_facets_free(&facets);
}

// Outward normals: each facet is the face of the first tetrahedron, though the second has the common face too. Inward
// ones: inside is what lies beyond, the second tetrahedron or nothing.
static void the_inside_follows_from_the_normals(void **state) {
  for (int inward = 0; inward < 2; inward++) {
    Two two;
    CwFacets facets;
    int32_t triangle[4][3];
    make(&two);
    const CwFillInput input = two_boundary(triangle, inward);
    assert_int_equal(cw_facets_make(&input, &two.mesh, &facets), CW_OK);
    assert_int_equal(cw_facets_locate(&two.mesh, 4, &facets), CW_OK);
    assert_int_equal(facets.missing_count, inward ? 3 : 0);
    for (int i = 0; i < 4; i++) {
      if (!inward) assert_int_equal(facets.inner[i], i);
      if (inward && i < 3) assert_true(facets.inner[i] < 0);
    }
    if (inward) assert_int_equal(facets.inner[3], 4 * 1 + 3);
    cw_facets_free(&facets);
  }
}

// Of the common face alone is left where the first tetrahedron is gone.
static void missing_facets_are_counted(void **state) {
  Two two;
  CwFacets facets;
  int32_t triangle[4][3];
  make(&two);
  two.tet[0].corner[0] = -1; // a free place
  two.tet[1].neighbour[3] = CW_BESIDE_OTHERS;
  const CwFillInput input = two_boundary(triangle, 1);
  assert_int_equal(cw_facets_make(&input, &two.mesh, &facets), CW_OK);
  assert_int_equal(cw_facets_locate(&two.mesh, 4, &facets), CW_OK);
  assert_int_equal(facets.missing_count, 3);
  assert_int_equal(facets.inner[3], 4 * 1 + 3);
  cw_facets_free(&facets);
}

static void a_triangle_listed_twice_is_told(void **state) {
  Two two;
  CwFacets facets;
  int32_t triangle[4][3];
  make(&two);
  const CwFillInput input = two_boundary(triangle, 0);
  for (int k = 0; k < 3; k++) triangle[2][k] = triangle[0][(k + 1) % 3];
  assert_int_equal(cw_facets_make(&input, &two.mesh, &facets), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "is listed twice"));
  cw_facets_free(&facets);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(facets_are_found_by_their_points),
      cmocka_unit_test(the_inside_follows_from_the_normals),
      cmocka_unit_test(missing_facets_are_counted),
      cmocka_unit_test(a_triangle_listed_twice_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
