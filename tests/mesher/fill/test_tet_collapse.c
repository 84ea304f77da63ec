// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "mesher/fill/delaunay.h"
#include "mesher/fill/tet_aspect.h"
#include "mesher/fill/tet_collapse.h"
#include "mesher/policy.h"
#include "shaken_lattice.h"

typedef struct {
  int count, used; // tetrahedra, and points that they have
  double six, excess, least;
} Shape;

static Shape shape_of(const CwTetWork *w) {
  Shape shape = {.least = 1.0};
  char *used = calloc((size_t)w->mesh->point_count, 1);
  assert_non_null(used);
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    const int32_t *c = w->mesh->tet[t].corner;
    if (c[0] < 0) continue;
    double quality = cw_tet_quality_of(w, c[0], c[1], c[2], c[3]);
    shape.six += cw_tet_volume6(cw_tet_at(w, c[0]), cw_tet_at(w, c[1]), cw_tet_at(w, c[2]), cw_tet_at(w, c[3]));
    shape.excess += cw_tet_excess(w, c);
    shape.least = fmin(shape.least, quality);
    shape.count++;
    for (int i = 0; i < 4; i++) {
      shape.used += !used[c[i]];
      used[c[i]] = 1;
      int32_t next = w->mesh->tet[t].neighbour[i]; // neighbours know one another
      assert_true(next < 0 || w->mesh->tet[next / 4].neighbour[next % 4] == 4 * t + i);
    }
  }
  free(used);
  return shape;
}

// A shaken lattice of unit cubes with one point more beside every so many-th inner one, shifted by so much, twice and
// three times that: before and after. Returns how many there are.
static int collapse_in_lattice(int every, double shift, int all_fixed, Shape *before, Shape *after, int *removed) {
  double(*x)[3];
  int32_t outside, count = shaken_lattice(8, 0.05, &outside, &x), total = count;
  CwTetMesh mesh;
  x = realloc(x, (size_t)(2 * count) * sizeof *x);
  assert_non_null(x);
  for (int32_t inner = outside + every / 2; inner < count; inner += every, total++) {
    for (int i = 0; i < 3; i++) x[total][i] = x[inner][i] + shift * (i + 1);
  }
  assert_int_equal(cw_delaunay_make(total, (const double(*)[3])x, &mesh), CW_OK);
  CwTetWork w = {.mesh = &mesh,
                 .limit = cw_policy.improve_below,
                 .fixed_count = all_fixed ? total : outside,
                 .source_count = total};
  CwTetShapes shapes = {.floor = 0.3};
  assert_int_equal(cw_tet_judge_all(&w, &shapes), CW_OK);
  *before = shape_of(&w);
  assert_int_equal(shapes.tet_count, before->count);
  assert_int_equal(cw_tet_collapse(&w, &shapes), CW_OK);
  *after = shape_of(&w);
  *removed = w.count.points_removed;
  assert_int_equal(after->used, before->used - *removed);
  assert_true(fabs(after->six / before->six - 1.0) < 1e-12);
  assert_true(after->least >= fmin(before->least, 0.3));
  cw_tet_shapes_free(&shapes);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
  free(x);
  return total - count;
}

static void a_point_too_near_goes(void **state) {
  Shape before, after;
  int removed;
  assert_int_equal(collapse_in_lattice(100000, 0.05, 0, &before, &after, &removed), 0);
  assert_int_equal(removed, 0);
  assert_int_equal(collapse_in_lattice(600, 0.05, 0, &before, &after, &removed), 1);
  assert_int_equal(removed, 1);
  assert_true(after.count < before.count);
  assert_true(after.excess < before.excess);
}

static void points_too_near_go_everywhere(void **state) {
  Shape before, after;
  int removed, more = collapse_in_lattice(5, 0.05, 0, &before, &after, &removed);
  assert_true(more > 100 && removed > 3 * more / 4);
  assert_true(after.excess < before.excess);
}

static void points_of_the_boundary_stay(void **state) {
  Shape before, after;
  int removed;
  collapse_in_lattice(5, 0.05, 1, &before, &after, &removed);
  assert_int_equal(removed, 0);
  assert_int_equal(after.count, before.count);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_point_too_near_goes),
      cmocka_unit_test(points_too_near_go_everywhere),
      cmocka_unit_test(points_of_the_boundary_stay),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
