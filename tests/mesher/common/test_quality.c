// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/common/quality.h"
#include "tests/unit_test.h"

static void regular_tetrahedron(void **state) {
  const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0.5, sqrt(0.75), 0};
  const double d[3] = {0.5, sqrt(1.0 / 12.0), sqrt(2.0 / 3.0)};
  const double *x[4] = {a, b, c, d};
  CwTetShape shape;
  cw_tet_shape(x, &shape);
  assert_near(shape.volume, 1.0 / (6.0 * sqrt(2.0)), 1e-15);
  assert_near(shape.edge_longest / shape.edge_shortest, 1.0, 1e-15);
  assert_near(shape.dihedral_least, 70.528779365509, 1e-9); // arccos(1/3)
  assert_near(shape.dihedral_greatest, 70.528779365509, 1e-9);
}

static void corner_of_a_cube(void **state) {
  const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0}, d[3] = {0, 0, 1};
  const double *x[4] = {a, b, c, d}, *turned[4] = {a, c, b, d};
  CwTetShape shape;
  cw_tet_shape(x, &shape);
  assert_near(shape.volume, 1.0 / 6.0, 1e-16);
  assert_near(shape.edge_longest / shape.edge_shortest, sqrt(2.0), 1e-15);
  assert_near(shape.dihedral_least, 54.735610317245, 1e-9); // arctan(sqrt 2)
  assert_near(shape.dihedral_greatest, 90.0, 1e-9);
  cw_tet_shape(turned, &shape);
  assert_near(shape.volume, -1.0 / 6.0, 1e-16);
  assert_near(shape.dihedral_least, 0.0, 0.0);
}

static void scaled_jacobian_of_prisms(void **state) {
  const double h = sqrt(0.75);
  double p[6][3] = {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1e-3}, {1, 0, 1e-3}, {0.5, h, 1e-3}};
  const double *x[6] = {p[0], p[1], p[2], p[3], p[4], p[5]};
  assert_near(cw_prism_scaled_jacobian(x), 1.0, 1e-14); // thin is not bad
  for (int k = 3; k < 6; k++) p[k][0] += 1e-3;          // sheared by 45 degrees
  assert_near(cw_prism_scaled_jacobian(x), sqrt(0.5), 1e-12);
  p[5][2] = -1e-3;
  assert_true(cw_prism_scaled_jacobian(x) < 0.0);
}

static void error_bound_covers_flat_tetrahedra(void **state) {
  const double a[3] = {0.1, 0.2, 0.3}, b[3] = {1.1, 0.7, 0.4}, c[3] = {0.3, 0.9, 0.7};
  double d[3];
  for (int i = 0; i < 3; i++) d[i] = a[i] + 0.3 * (b[i] - a[i]) + 0.4 * (c[i] - a[i]);
  assert_true(fabs(cw_tet_volume6(a, b, c, d)) < 1e-15);
  double error = cw_tet_volume6_error(a, b, c, d);
  assert_true(error > 0.0 && error < 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(regular_tetrahedron),
      cmocka_unit_test(corner_of_a_cube),
      cmocka_unit_test(scaled_jacobian_of_prisms),
      cmocka_unit_test(error_bound_covers_flat_tetrahedra),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
