// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/delaunay.h"
#include "mesher/fill/tet_topology.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static CwTetMesh random_mesh(uint64_t seed) {
  double x[300][3];
  CwTetMesh mesh;
  for (int i = 0; i < 900; i++) x[i / 3][i % 3] = draw(&seed);
  assert_int_equal(cw_delaunay_make(300, (const double(*)[3])x, &mesh), CW_OK);
  for (int32_t t = 0; t < mesh.tet_count; t++) mesh.tet[t].star = 0; // spheres stood there
  return mesh;
}

// A star is all tetrahedra with the point, each once; none where there are more than are allowed.
static void star_is_all_with_the_point(void **unused) {
  CwTetMesh mesh = random_mesh(5);
  for (int32_t p = CW_ENCLOSING_POINTS; p < mesh.point_count; p++) {
    int32_t star[300], first = -1;
    int count = 0;
    for (int32_t t = 0; t < mesh.tet_count; t++) {
      if (mesh.tet[t].corner[0] < 0 || cw_tet_corner_of(&mesh.tet[t], p) < 0) continue;
      first = t;
      count++;
    }
    assert_int_equal(cw_tet_star(&mesh, first, p, 300, star), count);
    for (int k = 0; k < count; k++) {
      assert_true(cw_tet_corner_of(&mesh.tet[star[k]], p) >= 0);
      for (int m = 0; m < k; m++) assert_int_not_equal(star[k], star[m]);
    }
    assert_int_equal(cw_tet_star(&mesh, first, p, count - 1, star), 0);
  }
  cw_tet_mesh_free(&mesh);
}

// Of all edges of a mesh, those with three or four tetrahedra, and of these both kinds; the ring is asked for the
// truth.
static void short_rings_are_known(void **unused) {
  CwTetMesh mesh = random_mesh(21);
  int edges[5] = {0};
  for (int32_t k = 0; k < 12 * mesh.tet_count; k++) {
    int32_t tet[4], ring[4], t = k / 12, i = k % 4, j = (i + 1 + k / 4 % 3) % 4;
    const int32_t *c = mesh.tet[t].corner;
    if (c[0] < 0) continue;
    int n = cw_tet_ring(&mesh, t, c[i], c[j], 4, tet, ring);
    assert_int_equal(cw_tet_ring_is_short(&mesh, t, c[i], c[j]), n != 0);
    edges[n]++;
  }
  assert_true(edges[0] > 1000 && edges[3] > 100 && edges[4] > 100);
  cw_tet_mesh_free(&mesh);
}

// Two tetrahedra at a face for three round an edge, and for two with another hull.
static void exchange_keeps_the_hull(void **unused) {
  CwTetMesh mesh = random_mesh(8);
  double six = joined_volume6(&mesh);
  int done = 0;
  for (int32_t t = 0; t < mesh.tet_count && !done; t++) {
    int32_t other = mesh.tet[t].neighbour[0], made[3][4], slot[3];
    if (mesh.tet[t].corner[0] < 0 || other < 0) continue;
    const int32_t *c = mesh.tet[t].corner, old[2] = {t, other / 4}, above = mesh.tet[other / 4].corner[other % 4];
    const double *x[4];
    int good = 1;
    for (int k = 0; k < 3; k++) {
      const int32_t one[4] = {c[cw_tet_face[0][k]], c[cw_tet_face[0][(k + 1) % 3]], c[0], above};
      for (int i = 0; i < 4; i++) x[i] = mesh.point[one[i]].x;
      good = good && cw_orient3d(x[0], x[1], x[2], x[3]) > 0;
      memcpy(made[k], one, sizeof one);
    }
    if (!good) continue;
    assert_int_equal(cw_tet_exchange(&mesh, 2, old, 3, (const int32_t(*)[4])made, slot), CW_OK);
    assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
    assert_int_equal(cw_tet_exchange(&mesh, 3, slot, 2, (const int32_t(*)[4])made, slot), CW_ERR_FAULT);
    done = 1;
  }
  assert_int_equal(done, 1);
  cw_tet_mesh_free(&mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(star_is_all_with_the_point),
      cmocka_unit_test(short_rings_are_known),
      cmocka_unit_test(exchange_keeps_the_hull),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
