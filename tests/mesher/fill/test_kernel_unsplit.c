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
#include "mesher/fill/kernel_unsplit.h"

// Corners of a tetrahedron, a point inside, and one that divides its boundary.
enum { INSIDE = 4, DIVIDER = 5, COUNT = 6 };

// The tetrahedra inside; number[k]: the mesh's number of point k.
static void make(const double divider[3], CwDelaunay *mesh, int32_t number[COUNT]) {
  double x[COUNT][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0.5, 0.5, 0.5}};
  memcpy(x[DIVIDER], divider, sizeof x[DIVIDER]);
  assert_int_equal(cw_delaunay_make(COUNT, (const double(*)[3])x, mesh), CW_OK);
  for (int32_t p = CW_DELAUNAY_CORNERS; p < mesh->point_count; p++) number[mesh->source[p]] = p;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    CwDelaunayTet *tet = &mesh->tet[t];
    int outside = 0;
    for (int i = 0; i < 4; i++) outside |= tet->corner[i] < CW_DELAUNAY_CORNERS;
    for (int i = 0; i < 4 && outside; i++) {
      if (tet->neighbour[i] >= 0) mesh->tet[tet->neighbour[i] / 4].neighbour[tet->neighbour[i] % 4] = -1;
    }
    if (outside) cw_delaunay_free_tet(mesh, t);
  }
}

// Sound, of the volume before; how many open faces there are, and how many have the divider.
static void look(const CwDelaunay *mesh, int32_t divider, int *open, int *with_divider) {
  *open = *with_divider = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const CwDelaunayTet *tet = &mesh->tet[t];
    if (tet->corner[0] < 0) continue;
    for (int i = 0; i < 4; i++) {
      if (tet->neighbour[i] >= 0) continue;
      ++*open;
      for (int k = 0; k < 3; k++) *with_divider += tet->corner[tet_face[i][k]] == divider;
    }
  }
  assert_true(fabs(joined_volume6(mesh) - 8.0) < 1e-12);
}

static void check(const double divider[3], CwSplit split, int open_before) {
  CwDelaunay mesh;
  int32_t number[COUNT];
  int open, with_divider, good;
  make(divider, &mesh, number);
  look(&mesh, number[DIVIDER], &open, &with_divider);
  assert_int_equal(open, open_before);
  assert_true(with_divider >= 3);
  split.point = number[DIVIDER];
  for (int k = 0; k < split.count; k++) {
    split.apex[k] = number[split.apex[k]];
    for (int i = 0; i < 2; i++) split.ends[k][i] = number[split.ends[k][i]];
  }
  CwSplits splits = {.split = &split, .count = 1};
  assert_int_equal(cw_kernel_unsplit(&mesh, &splits, &good), CW_OK);
  assert_true(good);
  look(&mesh, number[DIVIDER], &open, &with_divider);
  assert_int_equal(open, 4);
  assert_int_equal(with_divider, 0);
  cw_delaunay_free(&mesh);
}

static void point_leaves_an_edge(void **state) {
  check((double[3]){1, 0, 0}, (CwSplit){.count = 2, .ends = {{0, 1}, {1, 0}}, .apex = {3, 2}}, 6);
}

static void point_leaves_a_face(void **state) {
  check((double[3]){0.5, 0.5, 0}, (CwSplit){.count = 1, .ends = {{0, 2}}, .apex = {1}}, 6);
}

// Triangles that are not there cannot become whole.
static void wrong_triangles_are_refused(void **state) {
  CwDelaunay mesh;
  int32_t number[COUNT];
  int good;
  make((double[3]){1, 0, 0}, &mesh, number);
  CwSplit split = {number[DIVIDER], 2, {{number[1], number[2]}, {number[2], number[1]}}, {number[3], number[0]}};
  CwSplits splits = {.split = &split, .count = 1};
  assert_int_equal(cw_kernel_unsplit(&mesh, &splits, &good), CW_OK);
  assert_false(good);
  cw_delaunay_free(&mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(point_leaves_an_edge),
      cmocka_unit_test(point_leaves_a_face),
      cmocka_unit_test(wrong_triangles_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
