// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/common/quality.h"
#include "mesher/common/triangle_bound.h"
#include "tests/unit_test.h"

// Two triangles over the x axis, as narrow as `angle`; the fluid lies between them.
static void angles_of_a_wedge(void **state) {
  for (double angle = 5; angle < 360; angle += 10) {
    const double from[3] = {0, 0, 0}, to[3] = {2, 0, 0}, c = cos(angle * CW_DEGREE), s = sin(angle * CW_DEGREE);
    const double below[3] = {0, 0, -3}, above[3] = {0, -0.5 * s, 0.5 * c}; // normals out of the fluid
    double found = cw_inner_angle(to, from, below, above);
    assert_near(found, angle < 90 ? angle : 90, 1e-9);
    assert_near(cw_inner_angle(from, to, above, below), found, 1e-9); // the edge as the other triangle has it
  }
}

// The fourth corner of a regular tetrahedron is the apex across all three edges; across one alone, the others hold half
// the angles that they have.
static void what_a_triangle_allows(void **state) {
  const double r = sqrt(3) / 2, a[3] = {0, 0, 0}, b[3] = {0.5, r, 0}, c[3] = {1, 0, 0};
  const double d[3] = {0.5, r / 3, sqrt(2.0 / 3)}, regular = acos(1.0 / 3) / CW_DEGREE;
  const double *const corner[3] = {a, b, c}; // normal down
  const CwBoundSide open = {90, -1, NULL}, at_d = {regular, 7, d}, narrow = {20, 7, d};
  assert_near(cw_triangle_bound(corner, (CwBoundSide[3]){open, open, open}, 90), CW_TET_BOUND_MOST, 1e-9);
  assert_near(cw_triangle_bound(corner, (CwBoundSide[3]){at_d, at_d, at_d}, 90), regular, 1e-9);
  assert_near(cw_triangle_bound(corner, (CwBoundSide[3]){at_d, open, open}, 90), 45, 1e-9);
  assert_near(cw_triangle_bound(corner, (CwBoundSide[3]){narrow, open, open}, 90), 45, 1e-9);
  const CwBoundSide other = {20, 8, (double[3]){0.5, r / 3, 0.01}}; // two narrow edges with two apexes
  double bound = cw_triangle_bound(corner, (CwBoundSide[3]){narrow, other, open}, 90);
  assert_near(bound, 10, 1e-9);
  assert_true(cw_triangle_bound(corner, (CwBoundSide[3]){at_d, at_d, at_d}, 30) >= 30); // none of the worst
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(angles_of_a_wedge), cmocka_unit_test(what_a_triangle_allows)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
