// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fill/tet_judge.h"
#include "mesher/policy.h"
#include "shaken_lattice.h"
#include "tests/unit_test.h"

static const double NEAR = 1e-4;   // of qualities and squared ratios: single precision
static const double REGULAR = 0.8; // of tet_judge.c: below it the points of a tetrahedron are no lattice
static const int edge_of[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

typedef struct {
  CwTetMesh mesh;
  CwTetWork work;
  CwTetShapes shapes;
} Judged;

static void make(Judged *j, double shake) {
  double(*x)[3];
  int32_t outside;
  memset(j, 0, sizeof *j);
  const int32_t count = shaken_lattice(5, shake, &outside, &x, &j->mesh);
  free(x);
  j->work = (CwTetWork){.mesh = &j->mesh, .limit = 0.5, .fixed_count = outside, .source_count = count};
  j->shapes.floor = 0.5;
  j->shapes.irregular = calloc((size_t)j->mesh.point_count, 1);
  assert_non_null(j->shapes.irregular);
}

static void release(Judged *j) {
  cw_tet_shapes_free(&j->shapes);
  cw_tet_work_free(&j->work);
  cw_tet_mesh_free(&j->mesh);
}

static int is_inner(const CwTetMesh *mesh, int32_t t) {
  const int32_t *c = mesh->tet[t].corner;
  return c[0] >= CW_ENCLOSING_POINTS && c[1] >= CW_ENCLOSING_POINTS && c[2] >= CW_ENCLOSING_POINTS &&
         c[3] >= CW_ENCLOSING_POINTS;
}

static int times_in(const CwTetList *list, int32_t t) {
  int times = 0;
  for (int32_t k = 0; k < list->count; k++) times += list->tet[k] == t;
  return times;
}

// Longest over shortest edge, squared.
static double stretch_of(const CwTetMesh *mesh, int32_t t) {
  double least = INFINITY, most = 0;
  for (int e = 0; e < 6; e++) {
    const double *a = mesh->point[mesh->tet[t].corner[edge_of[e][0]]].x;
    const double *b = mesh->point[mesh->tet[t].corner[edge_of[e][1]]].x;
    const double square = pow(b[0] - a[0], 2) + pow(b[1] - a[1], 2) + pow(b[2] - a[2], 2);
    least = fmin(least, square);
    most = fmax(most, square);
  }
  return most / least;
}

static double exact_of(const CwTetWork *w, int32_t t) {
  const int32_t *c = w->mesh->tet[t].corner;
  return cw_tet_quality_of(w, c[0], c[1], c[2], c[3]);
}

// Each tetrahedron by itself, in double precision, beside what all of them were judged to be.
static void all_are_judged(void **state) {
  Judged j;
  make(&j, 0.3);
  j.mesh.tet[0].pass = 3;
  j.mesh.tet[0].star = 4;
  assert_int_equal(cw_tet_judge_all(&j.work, &j.shapes), CW_OK);
  assert_int_equal(j.mesh.tet[0].star, 0);
  int bad = 0, slender = 0, irregular = 0, seen = 0;
  uint8_t *marked = calloc((size_t)j.mesh.point_count, 1), *unsure = calloc((size_t)j.mesh.point_count, 1);
  assert_true(marked && unsure);
  for (int32_t t = 0; t < j.mesh.tet_count; t++) {
    const CwTet *tet = &j.mesh.tet[t];
    if (tet->corner[0] < 0) continue;
    const double exact = exact_of(&j.work, t), stretch = stretch_of(&j.mesh, t);
    for (int i = 0; i < 4; i++) {
      marked[tet->corner[i]] |= exact < REGULAR - NEAR || !is_inner(&j.mesh, t);
      unsure[tet->corner[i]] |= fabs(exact - REGULAR) <= NEAR;
    }
    if (!is_inner(&j.mesh, t)) continue;
    assert_near(tet->quality, exact, exact < j.work.limit ? 0 : NEAR);
    assert_int_equal(times_in(&j.work.next, t), exact < j.work.limit);
    if (fabs(stretch / cw_tet_slender_square() - 1) > NEAR)
      assert_int_equal(times_in(&j.shapes.slender, t), stretch > cw_tet_slender_square());
    bad += exact < j.work.limit;
    slender += stretch > cw_tet_slender_square();
    seen++;
  }
  for (int32_t p = CW_ENCLOSING_POINTS; p < j.mesh.point_count; p++) {
    if (!unsure[p]) assert_int_equal(j.shapes.irregular[p], marked[p]);
    irregular += marked[p];
  }
  // Of each kind some, and not all.
  assert_in_range(bad, 20, seen - 20);
  assert_in_range(slender, 20, seen - 20);
  assert_true(irregular > 100);
  // Once more, and nothing is listed twice.
  const int32_t listed = j.work.next.count, kept = j.shapes.slender.count;
  assert_int_equal(cw_tet_judge_all(&j.work, &j.shapes), CW_OK);
  assert_int_equal(j.shapes.slender.count, kept);
  assert_true(j.work.next.count >= listed);
  free(marked);
  free(unsure);
  release(&j);
}

// Of a lattice that is hardly shaken, the points two cubes below the skin are regular; near the skin they are not.
static void lattice_is_regular(void **state) {
  Judged j;
  make(&j, 1e-3);
  assert_int_equal(cw_tet_judge_all(&j.work, &j.shapes), CW_OK);
  int deep = 0, rough = 0;
  for (int32_t p = CW_ENCLOSING_POINTS; p < j.mesh.point_count; p++) {
    const double *x = j.mesh.point[p].x;
    const double depth = fmin(fmin(fmin(x[0], 5 - x[0]), fmin(x[1], 5 - x[1])), fmin(x[2], 5 - x[2])); // below the skin
    if (depth > 1.9) {
      assert_int_equal(j.shapes.irregular[p], 0);
      deep++;
    }
    if (depth < 0.1) rough += j.shapes.irregular[p];
  }
  assert_int_equal(deep, 2 * 2 * 2 + 1);
  assert_true(rough > 100);
  release(&j);
}

// A point that is to go beyond one of its tetrahedra spoils it, unless that was as bad before, or may be so.
static void moves_spoil(void **state) {
  Judged j;
  make(&j, 0.05);
  assert_int_equal(cw_tet_judge_all(&j.work, &j.shapes), CW_OK);
  int32_t p = CW_ENCLOSING_POINTS;
  while (hypot(hypot(j.mesh.point[p].x[0] - 2.5, j.mesh.point[p].x[1] - 2.5), j.mesh.point[p].x[2] - 2.5) > 0.3) p++;
  const double before[3] = {j.mesh.point[p].x[0], j.mesh.point[p].x[1], j.mesh.point[p].x[2]};
  double goal[3];
  cw_tet_goal(&j.work, &j.shapes, p, goal);
  assert_memory_equal(goal, before, sizeof goal);
  j.shapes.place[p] = j.shapes.place[p] + cw_4f_difference((double[3]){0, 0, 0}, (double[3]){0.4, -0.3, 0});
  cw_tet_goal(&j.work, &j.shapes, p, goal);
  for (int i = 0; i < 3; i++) assert_near(goal[i], before[i] + (i == 0 ? 0.4 : i == 1 ? -0.3 : 0), 1e-6);

  int32_t list[64 + CW_TET_PAD], count = 0;
  for (int32_t t = 0; t < j.mesh.tet_count; t++) {
    if (j.mesh.tet[t].corner[0] >= 0 && cw_tet_corner_of(&j.mesh.tet[t], p) >= 0) list[count++] = t;
  }
  assert_in_range(count, 8, 64);
  cw_tet_pad_list(list, count);
  for (int k = 0; k < CW_TET_PAD; k++) assert_int_equal(list[count + k], list[count - 1]);
  CwTetList spoilt = {0};
  assert_int_equal(cw_tet_judge(&j.work, &j.shapes, list, count, &spoilt), CW_OK);
  int wanted = 0;
  for (int k = 0; k < count; k++) {
    const int32_t t = list[k], *c = j.mesh.tet[t].corner;
    const double old = exact_of(&j.work, t);
    double x[4][3];
    for (int i = 0; i < 4; i++) cw_tet_goal(&j.work, &j.shapes, c[i], x[i]);
    const double after = cw_tet_quality(x[0], x[1], x[2], x[3]);
    const int is_spoilt = after < j.shapes.floor && after < old;
    assert_near(j.mesh.tet[t].quality, after, after < j.work.limit ? 0 : NEAR);
    assert_int_equal(times_in(&spoilt, t), is_spoilt);
    assert_int_equal(cw_tet_is_spoilt(&j.work, &j.shapes, t), is_spoilt);
    wanted += is_spoilt;
  }
  assert_in_range(wanted, 1, count - 1);
  j.shapes.floor = -2; // below any quality
  spoilt.count = 0;
  assert_int_equal(cw_tet_judge(&j.work, &j.shapes, list, count, &spoilt), CW_OK);
  assert_int_equal(spoilt.count, 0);
  free(spoilt.tet);
  release(&j);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_are_judged),
      cmocka_unit_test(lattice_is_regular),
      cmocka_unit_test(moves_spoil),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
