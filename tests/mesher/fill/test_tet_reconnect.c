// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/fill_mesh.h"
#include "mesher/fill/tet_reconnect.h"
#include "tests/unit_test.h"

enum { MOST = 8 };

// n tetrahedra round the edge 0-1 along z, half as long as `half`; the ring stands at `turn` and is flattened along y.
static CwTetMesh wheel(int n, double half, double flat) {
  double(*x)[3] = calloc((size_t)n + 2, sizeof *x);
  int32_t(*tet)[4] = calloc((size_t)n, sizeof *tet);
  CwFill fill = {.point_count = n + 2, .x = x, .tetrahedron_count = n, .tetrahedron = tet};
  CwTetMesh mesh;
  x[0][2] = -half;
  x[1][2] = half;
  for (int k = 0; k < n; k++) {
    double angle = 2.0 * 3.14159265358979323846 * (k + 0.3) / n;
    x[2 + k][0] = cos(angle);
    x[2 + k][1] = flat * sin(angle);
    memcpy(tet[k], (int32_t[4]){0, 1, 2 + k, 2 + (k + 1) % n}, sizeof *tet);
    if (cw_tet_volume6(x[0], x[1], x[2 + k], x[2 + (k + 1) % n]) < 0.0) tet[k][0] = 1, tet[k][1] = 0;
  }
  assert_int_equal(cw_fill_to_mesh(&fill, &mesh), CW_OK);
  cw_fill_free(&fill);
  return mesh;
}

static double least_of(const CwTetMesh *mesh, int *count) {
  double least = INFINITY;
  *count = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    if (c[0] < 0) continue;
    ++*count;
    least =
        fmin(least, cw_tet_quality(mesh->point[c[0]].x, mesh->point[c[1]].x, mesh->point[c[2]].x, mesh->point[c[3]].x));
  }
  return least;
}

// The best least quality of all triangulations of the ring's part i..j, tried one by one.
static double best_of(const CwTetMesh *mesh, int n, int i, int j) {
  double best = j - i < 2 ? INFINITY : -INFINITY;
  const CwTetPoint *p = mesh->point + CW_ENCLOSING_POINTS;
  for (int k = i + 1; k < j; k++) {
    const double *a = p[2 + i].x, *b = p[2 + k].x, *c = p[2 + j].x;
    double here = fmin(cw_tet_quality(a, b, c, p[1].x), cw_tet_quality(a, c, b, p[0].x));
    best = fmax(best, fmin(here, fmin(best_of(mesh, n, i, k), best_of(mesh, n, k, j))));
  }
  return best;
}

static void an_edge_goes_where_that_is_best(void **unused) {
  int gone = 0, kept = 0;
  for (int n = 3; n <= MOST + 1; n++) {
    for (int shape = 0; shape < 6; shape++) {
      CwTetMesh mesh = wheel(n, shape % 3 == 0 ? 0.3 : shape % 3 == 1 ? 1.0 : 3.0, shape < 3 ? 1.0 : 0.6);
      CwTetWork w = {.mesh = &mesh};
      int done_it, count;
      double six = joined_volume6(&mesh), before = least_of(&mesh, &count), best = best_of(&mesh, n, 0, n - 1);
      for (int32_t t = 0; t < mesh.tet_count; t++) {
        const int32_t *c = mesh.tet[t].corner;
        mesh.tet[t].quality = cw_tet_quality_of(&w, c[0], c[1], c[2], c[3]);
      }
      assert_int_equal(cw_tet_remove_edge(&w, 0, CW_ENCLOSING_POINTS, CW_ENCLOSING_POINTS + 1, &done_it), CW_OK);
      assert_int_equal(done_it, n <= MOST && best > before + 1e-6);
      double after = least_of(&mesh, &count);
      assert_int_equal(count, done_it ? 2 * (n - 2) : n);
      assert_true(after == (done_it ? best : before));
      assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
      gone += done_it;
      kept += !done_it;
      cw_tet_work_free(&w);
      cw_tet_mesh_free(&mesh);
    }
  }
  assert_true(gone > 5 && kept > 5);
}

// A face whose edge across is short: three tetrahedra round that edge are better; back they go by its removal.
static void a_face_goes_and_comes_back(void **unused) {
  CwTetMesh mesh = wheel(3, 0.3, 1.0);
  CwTetWork w = {.mesh = &mesh};
  int done_it, count;
  const double before = least_of(&mesh, &count);
  for (int32_t t = 0; t < 3; t++) mesh.tet[t].quality = -1.0; // anything is better
  assert_int_equal(cw_tet_remove_edge(&w, 0, CW_ENCLOSING_POINTS, CW_ENCLOSING_POINTS + 1, &done_it), CW_OK);
  assert_int_equal(done_it, 1);
  double two = least_of(&mesh, &count), six = joined_volume6(&mesh);
  assert_int_equal(count, 2);
  assert_true(before > 1.1 * two);
  for (int32_t t = 0; t < mesh.tet_count; t++) {
    int inner = -1;
    for (int i = 0; i < 4 && mesh.tet[t].corner[0] >= 0; i++) inner = mesh.tet[t].neighbour[i] >= 0 ? i : inner;
    if (inner < 0) continue;
    assert_int_equal(cw_tet_remove_face(&w, t, inner, &done_it), CW_OK);
    break;
  }
  assert_int_equal(done_it, 1);
  assert_near(least_of(&mesh, &count), before, 1e-12);
  assert_int_equal(count, 3);
  assert_true(fabs(joined_volume6(&mesh) / six - 1.0) < 1e-12);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_edge_goes_where_that_is_best),
      cmocka_unit_test(a_face_goes_and_comes_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
