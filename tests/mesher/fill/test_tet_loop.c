// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/policy.h"
#include "shaken_lattice.h"
#include "tests/unit_test.h"

typedef struct {
  double (*x)[3];
  int32_t outside, points; // of the lattice
  CwTetMesh mesh;
  CwTetWork w;
} Lattice;

// All below the limit are in the list.
static void make_lattice(Lattice *l) {
  l->points = shaken_lattice(4, 0.4, &l->outside, &l->x, &l->mesh);
  l->w = (CwTetWork){.mesh = &l->mesh,
                     .fixed_count = l->outside,
                     .source_count = l->points,
                     .limit = cw_policy.improve_below,
                     .insert = cw_policy.improve_below,
                     .insert_round = 0.34};
  for (int32_t p = 0; p < l->mesh.point_count; p++) l->mesh.point[p].mark = 0;
  for (int32_t t = 0; t < l->mesh.tet_count; t++) {
    CwTet *tet = &l->mesh.tet[t];
    const int32_t *c = tet->corner;
    tet->star = 0;
    tet->pass = CW_TET_NO_PASS;
    if (c[0] < 0) continue;
    tet->quality = cw_tet_quality_of(&l->w, c[0], c[1], c[2], c[3]);
    if (tet->quality < l->w.limit) assert_int_equal(cw_tet_push(&l->w, t), CW_OK);
  }
}

static void free_lattice(Lattice *l) {
  free(l->x);
  cw_tet_work_free(&l->w);
  cw_tet_mesh_free(&l->mesh);
}

typedef struct {
  double least, six;
  int poor; // below the limit
} Shape;

// Also that the kept qualities are those there are, and all poor ones are listed.
static Shape shape_of(const Lattice *l) {
  Shape s = {.least = 1, .six = joined_volume6(&l->mesh)};
  for (int32_t t = 0; t < l->mesh.tet_count; t++) {
    const int32_t *c = l->mesh.tet[t].corner;
    if (c[0] < 0) continue;
    const double quality = cw_tet_quality_of(&l->w, c[0], c[1], c[2], c[3]);
    assert_near(l->mesh.tet[t].quality, quality, 1e-15);
    s.least = fmin(s.least, quality);
    if (quality >= l->w.limit) continue;
    int listed = 0;
    s.poor++;
    for (int32_t k = 0; k < l->w.next.count; k++) listed |= l->w.next.tet[k] == t;
    assert_true(listed);
  }
  return s;
}

static int32_t moved_of(const Lattice *l) {
  int32_t moved = 0;
  for (int32_t p = 0; p < l->mesh.point_count; p++) {
    const int32_t source = l->mesh.source[p];
    if (source < 0 || source >= l->points) continue;
    const int same = !memcmp(l->mesh.point[p].x, l->x[source], sizeof l->x[0]);
    if (source < l->outside) assert_true(same); // given points stay
    moved += !same;
  }
  return moved;
}

static void a_loop_only_improves(void **state) {
  Lattice l;
  for (int move = 0; move < 2; move++) {
    make_lattice(&l);
    Shape before = shape_of(&l);
    assert_true(before.poor > 50);
    const double six = before.six;
    for (int round = 0; round < 4; round++) {
      assert_int_equal(cw_tet_improve_list(&l.w, 1 + round, move), CW_OK);
      const Shape after = shape_of(&l);
      assert_near(after.six / six, 1, 1e-12);
      assert_true(after.least >= before.least);
      assert_true(after.poor <= before.poor);
      before = after;
      // A first pass adds no points.
      if (round == 0) assert_int_equal(l.w.count.points_added, 0);
      if (round == 0) assert_int_equal(l.mesh.point_count, l.points + CW_ENCLOSING_POINTS);
    }
    assert_int_equal(moved_of(&l) > 0, move);
    assert_true(l.w.count.edges_removed + l.w.count.faces_removed > 20);
    assert_true(l.w.count.points_added > 0);
    free_lattice(&l);
  }
}

// Without passes, or with nothing in the list, all stays; with passes to spare the loop ends where nothing changes, so
// that another one finds little to do.
static void a_loop_ends(void **state) {
  Lattice l;
  make_lattice(&l);
  const Shape before = shape_of(&l);
  const int32_t listed = l.w.next.count;
  assert_int_equal(cw_tet_improve_list(&l.w, 0, 1), CW_OK);
  assert_int_equal(l.w.next.count, listed);
  l.w.next.count = 0;
  assert_int_equal(cw_tet_improve_list(&l.w, 10, 1), CW_OK);
  assert_int_equal(l.w.pass, 0);
  assert_int_equal(moved_of(&l), 0);
  l.w.next.count = listed;
  const Shape same = shape_of(&l);
  assert_true(same.least == before.least && same.poor == before.poor);
  assert_int_equal(cw_tet_improve_list(&l.w, 1000, 1), CW_OK);
  assert_true(l.w.pass > 2 && l.w.pass < 100);
  free_lattice(&l);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_loop_only_improves),
      cmocka_unit_test(a_loop_ends),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
