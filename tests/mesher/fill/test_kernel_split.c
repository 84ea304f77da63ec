// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "joined_mesh.h"
#include "mesher/common/vec.h"
#include "mesher/fill/kernel_split.h"

enum { POINTS = 6, TRIANGLES = 8 };

// E. Schonhardt's polyhedron (Math. Ann. 98, 1928), a prism with three sides whose upper end is turned by 30 degrees
// against their diagonals, so that they bend inwards; no tetrahedra on its corners alone fill it.
static void schoenhardt(double x[POINTS][3], int32_t triangle[TRIANGLES][3]) {
  const double third = 2.0 * acos(-1.0) / 3.0;
  for (int k = 0; k < POINTS; k++) {
    double angle = third * (k % 3) + (k < 3 ? 0.0 : -third / 4);
    x[k][0] = cos(angle);
    x[k][1] = sin(angle);
    x[k][2] = k < 3 ? 0.0 : 1.0;
  }
  const int32_t ends[2][3] = {{0, 2, 1}, {3, 4, 5}};
  memcpy(triangle, ends, sizeof ends);
  for (int32_t k = 0; k < 3; k++) {
    const int32_t next = (k + 1) % 3, side[2][3] = {{k, next, k + 3}, {next, next + 3, k + 3}};
    memcpy(triangle[2 + 2 * k], side, sizeof side);
  }
}

// How far the divided edge, or triangle, is from its point, over its size.
static double distance(const CwDelaunay *mesh, const CwSplit *split) {
  const double *x = mesh->point[split->point].x, *a = mesh->point[split->ends[0][0]].x,
               *b = mesh->point[split->ends[0][1]].x, *c = mesh->point[split->apex[0]].x;
  double u[3], v[3], to[3], normal[3];
  cw_sub(b, a, u);
  cw_sub(x, a, to);
  if (split->count == 2) {
    cw_cross(u, to, normal);
    return sqrt(cw_dot(normal, normal)) / cw_dot(u, u);
  }
  cw_sub(c, a, v);
  cw_cross(u, v, normal);
  return fabs(cw_dot(normal, to)) / cw_dot(normal, normal);
}

typedef struct {
  CwDelaunay mesh;
  CwFacets facets;
  CwSplits splits;
  CwRecovered recovered;
  int32_t sources;
} Divided;

static void divide(Divided *d) {
  double x[POINTS][3];
  int32_t triangle[TRIANGLES][3];
  schoenhardt(x, triangle);
  CwFillInput input = {.point_count = POINTS,
                       .x = (const double(*)[3])x,
                       .triangle_count = TRIANGLES,
                       .triangle = (const int32_t(*)[3])triangle,
                       .name = "rotor region 3"};
  memset(d, 0, sizeof *d);
  d->sources = POINTS;
  assert_int_equal(cw_delaunay_make(POINTS, input.x, &d->mesh), CW_OK);
  double six = joined_volume6(&d->mesh);
  assert_int_equal(cw_facets_make(&input, &d->mesh, &d->facets), CW_OK);
  assert_int_equal(cw_facets_locate(&d->mesh, POINTS, &d->facets), CW_OK);
  // All six points lie on a sphere; of the three diagonals inside any two cross one another, so one is there at most.
  assert_true(d->facets.missing_count >= 4);
  assert_int_equal(cw_kernel_split(&d->mesh, &d->facets, &d->sources, &d->splits, &d->recovered), CW_OK);
  assert_true(fabs(joined_volume6(&d->mesh) / six - 1.0) < 1e-12);
}

static void divided_free(Divided *d) {
  cw_splits_free(&d->splits);
  cw_facets_free(&d->facets);
  cw_delaunay_free(&d->mesh);
}

static void schoenhardts_polyhedron_is_recovered(void **unused) {
  Divided d;
  divide(&d);
  assert_int_equal(cw_facets_locate(&d.mesh, POINTS, &d.facets), CW_OK);
  assert_int_equal(d.facets.missing_count, 0);
  assert_true(d.splits.count >= 1);
  assert_true(d.sources >= POINTS + d.splits.count);
  for (int32_t k = 0; k < d.splits.count; k++) {
    const CwSplit *split = &d.splits.split[k];
    assert_true(d.mesh.source[split->point] >= POINTS);
    assert_true(distance(&d.mesh, split) < 2e-5);
  }
  divided_free(&d);
}

// No dependence on addresses or on what ran before.
static void divided_twice_is_divided_alike(void **unused) {
  Divided d, again;
  divide(&d);
  divide(&again);
  assert_int_equal(d.mesh.tet_count, again.mesh.tet_count);
  assert_int_equal(d.mesh.point_count, again.mesh.point_count);
  assert_int_equal(d.splits.count, again.splits.count);
  for (int32_t t = 0; t < d.mesh.tet_count; t++) {
    assert_memory_equal(d.mesh.tet[t].corner, again.mesh.tet[t].corner, sizeof d.mesh.tet[t].corner);
  }
  for (int32_t p = CW_DELAUNAY_CORNERS; p < d.mesh.point_count; p++) {
    assert_memory_equal(d.mesh.point[p].x, again.mesh.point[p].x, sizeof d.mesh.point[p].x);
  }
  divided_free(&d);
  divided_free(&again);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(schoenhardts_polyhedron_is_recovered),
      cmocka_unit_test(divided_twice_is_divided_alike),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
