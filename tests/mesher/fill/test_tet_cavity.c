// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/predicates.h"
#include "mesher/fill/tet_cavity.h"
#include "tests/unit_test.h"

static const double tip[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};

// The inside of an octahedron: faces seen from its middle.
static CwCavity octahedron(void) {
  CwCavity cavity = {.count = 8};
  for (int k = 0; k < 8; k++) {
    const double *x = tip[k & 1 ? 3 : 0], *y = tip[k & 2 ? 4 : 1], *z = tip[k & 4 ? 5 : 2];
    const double middle[3] = {0, 0, 0};
    int turned = cw_orient3d(x, y, z, middle) < 0;
    cavity.face[k][0] = x;
    cavity.face[k][1] = turned ? z : y;
    cavity.face[k][2] = turned ? y : z;
  }
  return cavity;
}

// Least over the faces, one by one.
static double least_of(const CwCavity *cavity, const double p[3]) {
  double least = INFINITY;
  for (int k = 0; k < cavity->count; k++)
    least = fmin(least, cw_tet_quality(cavity->face[k][0], cavity->face[k][1], cavity->face[k][2], p));
  return least;
}

static void quality_is_the_least_of_all(void **unused) {
  CwCavity cavity = octahedron();
  const double p[3][3] = {{0, 0, 0}, {0.2, -0.1, 0.05}, {0.5, 0.4, 0.3}}; // the last one outside
  for (int k = 0; k < 3; k++) assert_true(cw_cavity_quality(&cavity, p[k], -2.0) == least_of(&cavity, p[k]));
  assert_true(least_of(&cavity, p[2]) < 0.0);
  // What is not above `enough` ends it, and is found sooner the next time.
  assert_true(cw_cavity_quality(&cavity, p[1], 1.0) >= least_of(&cavity, p[1]));
}

// By symmetry the middle is best: right angles, whose sine is 1, and an edge ratio of sqrt 2.
static void search_ends_in_the_middle(void **unused) {
  const double middle[3] = {0, 0, 0}, start[3][3] = {{0.3, 0.2, 0.1}, {-0.1, 0.4, 0.2}, {0.05, -0.3, 0.3}};
  for (int k = 0; k < 3; k++) {
    CwCavity cavity = octahedron();
    double p[3] = {start[k][0], start[k][1], start[k][2]};
    double found = cw_cavity_best(&cavity, p, least_of(&cavity, p));
    assert_true(found == least_of(&cavity, p));
    assert_true(found > least_of(&cavity, middle) - 1e-12);
    assert_true(fabs(p[0]) + fabs(p[1]) + fabs(p[2]) < 1e-12); // the mean of the faces is tried first
  }
}

// Three faces of a corner cut off far above leave no symmetry: no place of a fine grid is better by much.
static void no_place_of_a_grid_is_better(void **unused) {
  static const double far[3] = {0.1, 0.2, 2.0};
  CwCavity cavity = octahedron();
  for (int k = 0; k < 8; k++) {
    for (int i = 0; i < 3; i++) {
      if (cavity.face[k][i] == tip[2]) cavity.face[k][i] = far;
    }
  }
  double p[3] = {0.2, -0.3, -0.2}, best = 0.0;
  double found = cw_cavity_best(&cavity, p, least_of(&cavity, p));
  for (int k = 0; k < 40 * 40 * 40; k++) {
    const double x[3] = {0.05 * (k % 40) - 1.0, 0.05 * (k / 40 % 40) - 1.0, 0.075 * (k / 1600) - 1.0};
    best = fmax(best, least_of(&cavity, x));
  }
  assert_true(best > 0.1);
  assert_true(found > 0.9 * best);
}

static void faces_are_seen_from_inside(void **unused) {
  const double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const CwTet tet = {.corner = {0, 1, 2, 3}};
  for (int i = 0; i < 4; i++) {
    int32_t face[3];
    cw_cavity_face(&tet, i, face);
    assert_int_equal(cw_orient3d(x[face[0]], x[face[1]], x[face[2]], x[i]), 1);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(quality_is_the_least_of_all),
      cmocka_unit_test(search_ends_in_the_middle),
      cmocka_unit_test(no_place_of_a_grid_is_better),
      cmocka_unit_test(faces_are_seen_from_inside),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
