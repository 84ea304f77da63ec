// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/delaunay.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static uint64_t state;

static int holds(const int32_t *list, int count, int32_t item) {
  for (int k = 0; k < count; k++) {
    if (list[k] == item) return 1;
  }
  return 0;
}

// Sound, filling the enclosing tetrahedron, each point in use, and every sphere empty of all points.
static void check(const CwTetMesh *mesh, int32_t count) {
  double six = joined_volume6(mesh), whole = 0.0;
  uint8_t *used = calloc((size_t)mesh->point_count, 1);
  int open = 0;
  assert_int_equal(mesh->point_count, count + CW_ENCLOSING_POINTS - mesh->duplicate_count);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const CwTet *tet = &mesh->tet[t];
    if (tet->corner[0] < 0) continue;
    const double *x[4];
    for (int i = 0; i < 4; i++) {
      x[i] = mesh->point[tet->corner[i]].x;
      used[tet->corner[i]] = 1;
      if (tet->neighbour[i] >= 0) continue;
      open++;
      for (int k = 0; k < 3; k++) assert_true(tet->corner[cw_tet_face[i][k]] < CW_ENCLOSING_POINTS);
    }
    for (int32_t p = 0; p < mesh->point_count; p++) {
      if (holds(tet->corner, 4, p)) continue;
      if (cw_insphere(x[0], x[1], x[2], x[3], mesh->point[p].x) > 0) fail_msg("point %d in the sphere of %d", p, t);
    }
  }
  assert_int_equal(open, 4);
  const double *a = mesh->point[0].x, *b = mesh->point[1].x;
  double edge = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
  whole = edge * edge * edge / sqrt(2.0); // six times the volume of a regular tetrahedron
  assert_true(fabs(six / whole - 1.0) < 1e-12);
  for (int32_t p = 0; p < mesh->point_count; p++) assert_true(used[p]);
  free(used);
}

static void connect_and_check(int32_t count, double (*x)[3], int32_t duplicates) {
  CwTetMesh mesh;
  if (cw_delaunay_make(count, (const double(*)[3])x, &mesh) != CW_OK) fail_msg("%s", cw_fail_message());
  assert_int_equal(mesh.duplicate_count, duplicates);
  for (int32_t p = CW_ENCLOSING_POINTS; p < mesh.point_count; p++) {
    assert_memory_equal(mesh.point[p].x, x[mesh.source[p]], sizeof *x);
  }
  check(&mesh, count);
  cw_tet_mesh_free(&mesh);
}

static void few_points(void **unused) {
  double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int32_t n = 1; n <= 4; n++) connect_and_check(n, x, 0);
}

static void random_points(void **unused) {
  double(*x)[3] = malloc(700 * sizeof *x);
  state = 7;
  for (int i = 0; i < 2100; i++) x[i / 3][i % 3] = draw(&state);
  connect_and_check(700, x, 0);
  for (int i = 0; i < 2100; i++) x[i / 3][i % 3] = 1e-3 * draw(&state) * draw(&state) * draw(&state) + 0.3;
  connect_and_check(700, x, 0);
  free(x);
}

// Half of the points come one by one, from any tetrahedron on; one of them is there already.
static void one_by_one(void **unused) {
  double(*x)[3] = malloc(600 * sizeof *x);
  CwTetMesh mesh;
  CwDelaunayInsertion *insertion;
  int32_t point;
  state = 11;
  for (int i = 0; i < 1800; i++) x[i / 3][i % 3] = draw(&state);
  assert_int_equal(cw_delaunay_make(300, (const double(*)[3])x, &mesh), CW_OK);
  assert_int_equal(cw_delaunay_open(&mesh, &insertion), CW_OK);
  for (int32_t p = 300; p < 600; p++) {
    int32_t near = p % 2 ? -1 : (int32_t)(draw(&state) * mesh.tet_count);
    if (near >= 0 && mesh.tet[near].corner[0] < 0) near = -1;
    assert_int_equal(cw_delaunay_insert(insertion, x[p], p, near, &point), CW_OK);
    assert_int_equal(point, CW_ENCLOSING_POINTS + p);
    assert_int_equal(mesh.source[point], p);
    assert_memory_equal(mesh.point[point].x, x[p], sizeof *x);
  }
  assert_int_equal(cw_delaunay_insert(insertion, x[450], 600, -1, &point), CW_OK);
  assert_int_equal(point, -1);
  cw_delaunay_close(&insertion);
  check(&mesh, 600);
  cw_tet_mesh_free(&mesh);
  free(x);
}

// Every other tetrahedron is freed: the rest keeps its order and its neighbours, with nothing between.
static void packed(void **unused) {
  double(*x)[3] = malloc(300 * sizeof *x);
  CwTetMesh mesh;
  state = 5;
  for (int i = 0; i < 900; i++) x[i / 3][i % 3] = draw(&state);
  assert_int_equal(cw_delaunay_make(300, (const double(*)[3])x, &mesh), CW_OK);
  int32_t before = mesh.tet_count, kept = 0, (*corner)[4] = malloc((size_t)before * sizeof *corner);
  for (int32_t t = 0; t < before; t++) {
    if (mesh.tet[t].corner[0] < 0) continue;
    if (t % 2 == 0) {
      memcpy(corner[kept++], mesh.tet[t].corner, sizeof *corner);
      continue;
    }
    for (int i = 0; i < 4; i++) {
      int32_t beyond = mesh.tet[t].neighbour[i];
      if (beyond >= 0) mesh.tet[beyond / 4].neighbour[beyond % 4] = -1;
    }
    cw_tet_mesh_free_tet(&mesh, t);
  }
  cw_tet_mesh_pack(&mesh);
  assert_int_equal(mesh.tet_count, kept);
  int joined = 0;
  for (int32_t t = 0; t < kept; t++) {
    const CwTet *tet = &mesh.tet[t];
    assert_memory_equal(tet->corner, corner[t], sizeof *corner);
    for (int i = 0; i < 4; i++) {
      if (tet->neighbour[i] < 0) continue;
      assert_true(tet->neighbour[i] / 4 < kept);
      const CwTet *other = &mesh.tet[tet->neighbour[i] / 4];
      assert_int_equal(other->neighbour[tet->neighbour[i] % 4], 4 * t + i);
      for (int k = 0; k < 3; k++) assert_true(holds(other->corner, 4, tet->corner[cw_tet_face[i][k]]));
      joined++;
    }
  }
  assert_true(joined > kept);
  int32_t next = -1;
  assert_int_equal(cw_tet_mesh_new_tet(&mesh, &next), CW_OK);
  assert_int_equal(next, kept);
  cw_tet_mesh_free(&mesh);
  free(corner);
  free(x);
}

// Eight and more points on each sphere, faces and edges through points: all ties.
static void grid(void **unused) {
  double(*x)[3] = malloc(7 * 8 * 9 * sizeof *x);
  for (int step = 0; step < 2; step++) {
    int n = 0;
    for (int i = 0; i < 7; i++) {
      for (int j = 0; j < 8; j++) {
        for (int k = 0; k < 9; k++) {
          double h = step ? 0.001 : 0.125; // 0.001 is no binary number: nearly cospherical
          const double p[3] = {h * i, h * j, h * k};
          memcpy(x[n++], p, sizeof p);
        }
      }
    }
    connect_and_check(n, x, 0);
  }
  free(x);
}

static void body_centred_grid(void **unused) {
  double(*x)[3] = malloc(2 * 6 * 6 * 6 * sizeof *x);
  int n = 0;
  for (int k = 0; k < 432; k++) {
    for (int i = 0; i < 3; i++) x[n][i] = (i == 0 ? k / 2 % 6 : i == 1 ? k / 12 % 6 : k / 72) + 0.5 * (k % 2);
    n++;
  }
  connect_and_check(n, x, 0);
  free(x);
}

// Grids shaken by 1e-8 to 1e-3 of a step, each as small as the rounding of a sphere far from the middle allows, or
// smaller: what single precision cannot tell, the exact predicate has to.
static void close_to_spheres(void **unused) {
  enum { SIDE = 5, GRIDS = 4 };
  static const double step[GRIDS] = {0.1, 1e-3, 1e-5, 1e-7}, shaken[GRIDS] = {1e-8, 1e-6, 1e-4, 1e-3};
  double(*x)[3] = malloc(GRIDS * SIDE * SIDE * SIDE * sizeof *x);
  int32_t count = 0;
  state = 17;
  for (int k = 0; k < GRIDS * SIDE * SIDE * SIDE; k++, count++) {
    int g = k / (SIDE * SIDE * SIDE), at[3] = {k % SIDE, k / SIDE % SIDE, k / (SIDE * SIDE) % SIDE};
    for (int i = 0; i < 3; i++) x[count][i] = (i == g % 3) + step[g] * (at[i] + shaken[g] * draw(&state));
  }
  connect_and_check(count, x, 0);
  free(x);
}

// All on one sphere, and on one circle, one line, one plane.
static void on_one_shape(void **unused) {
  double(*x)[3] = malloc(300 * sizeof *x);
  state = 11;
  for (int shape = 0; shape < 4; shape++) {
    for (int k = 0; k < 300; k++) {
      double a = 6.283185307179586 * k / 300, z = 2.0 * draw(&state) - 1.0, r = sqrt(1.0 - z * z),
             phi = 6.28 * draw(&state);
      double sphere[3] = {r * cos(phi), r * sin(phi), z}, circle[3] = {cos(a), sin(a), 0.25};
      double line[3] = {0.125 * k, 0.25 * k, 0.5 * k}, plane[3] = {draw(&state), draw(&state), 0.5};
      memcpy(x[k], shape == 0 ? sphere : shape == 1 ? circle : shape == 2 ? line : plane, sizeof *x);
    }
    connect_and_check(300, x, 0);
  }
  free(x);
}

// Many small sets, most of them degenerate: points of small lattices in any order, doubled ones, points of one
// sphere, a cylinder's grid, a plane or line with few others, and each of them stretched or far from the origin.
static void small_sets(void **unused) {
  double x[60][3];
  state = 23;
  for (int trial = 0; trial < 400; trial++) {
    int kind = trial % 6, count = 4 + (int)(draw(&state) * 56), kept = 0;
    double stretch = trial % 7 == 0 ? 1e-6 : 1.0, far = trial % 5 == 0 ? 1000.0 : 0.0;
    for (int k = 0; k < count; k++) {
      double p[3], a = 0.5235987755982988 * (int)(draw(&state) * 12.0), z = (int)(draw(&state) * 5.0) - 2.0;
      for (int i = 0; i < 3; i++) p[i] = kind == 0 ? (int)(draw(&state) * 4.0) : draw(&state);
      double r = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      for (int i = 0; i < 3 && kind == 1; i++) p[i] /= r;
      if (kind == 2) p[0] = cos(a), p[1] = sin(a), p[2] = z;
      if (kind == 3 && k % 6) p[2] = 0.5;
      if (kind == 4 && k % 6) p[1] = 2.0 * p[0], p[2] = -p[0];
      p[2] *= stretch;
      for (int i = 0; i < 3; i++) p[i] += far;
      int seen = 0;
      for (int m = 0; m < kept && !seen; m++)
        seen = memcmp(x[m], p, sizeof p) == 0 || (x[m][0] == p[0] && x[m][1] == p[1] && x[m][2] == p[2]);
      if (seen) continue;
      memcpy(x[kept++], p, sizeof p);
    }
    connect_and_check(kept, x, 0);
  }
}

// A new point whose cavity holds nearly everything: more points than the edge table has room for.
static void great_cavity(void **unused) {
  double x[402][3];
  state = 3;
  for (int k = 0; k < 402; k++) {
    double z = 2.0 * draw(&state) - 1.0, r = sqrt(1.0 - z * z), phi = 6.283185307179586 * draw(&state);
    x[k][0] = r * cos(phi), x[k][1] = r * sin(phi), x[k][2] = z;
  }
  memset(x[401], 0, sizeof x[401]);
  connect_and_check(402, x, 0);
}

static void duplicates_are_named(void **unused) {
  double x[64][3];
  CwTetMesh mesh;
  state = 5;
  for (int i = 0; i < 180; i++) x[i / 3][i % 3] = draw(&state);
  for (int k = 60; k < 64; k++) memcpy(x[k], x[7 * (k - 60)], sizeof *x);
  connect_and_check(64, x, 4);
  assert_int_equal(cw_delaunay_make(64, (const double(*)[3])x, &mesh), CW_OK);
  for (int32_t k = 0; k < 4; k++) {
    int32_t low = mesh.duplicate[k][0], high = mesh.duplicate[k][1];
    assert_true(low != high && low >= 0 && high >= 0);
    assert_memory_equal(x[low], x[high], sizeof *x);
  }
  cw_tet_mesh_free(&mesh);
}

static void equal_bits_twice(void **unused) {
  double(*x)[3] = malloc(5000 * sizeof *x);
  CwTetMesh one, two;
  state = 17;
  for (int i = 0; i < 15000; i++) x[i / 3][i % 3] = draw(&state);
  assert_int_equal(cw_delaunay_make(5000, (const double(*)[3])x, &one), CW_OK);
  assert_int_equal(cw_delaunay_make(5000, (const double(*)[3])x, &two), CW_OK);
  assert_int_equal(one.tet_count, two.tet_count);
  for (int32_t t = 0; t < one.tet_count; t++) {
    assert_memory_equal(one.tet[t].corner, two.tet[t].corner, sizeof one.tet[t].corner);
  }
  cw_tet_mesh_free(&one);
  cw_tet_mesh_free(&two);
  free(x);
}

static void wrong_points_are_an_error(void **unused) {
  double x[2][3] = {{0, 0, 0}, {0, NAN, 0}};
  CwTetMesh mesh;
  assert_int_equal(cw_delaunay_make(2, (const double(*)[3])x, &mesh), CW_ERR_MESH);
  assert_int_equal(cw_delaunay_make(0, (const double(*)[3])x, &mesh), CW_ERR_MESH);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(few_points),
      cmocka_unit_test(random_points),
      cmocka_unit_test(one_by_one),
      cmocka_unit_test(packed),
      cmocka_unit_test(grid),
      cmocka_unit_test(body_centred_grid),
      cmocka_unit_test(close_to_spheres),
      cmocka_unit_test(on_one_shape),
      cmocka_unit_test(small_sets),
      cmocka_unit_test(great_cavity),
      cmocka_unit_test(duplicates_are_named),
      cmocka_unit_test(equal_bits_twice),
      cmocka_unit_test(wrong_points_are_an_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
