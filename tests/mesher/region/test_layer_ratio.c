// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/region/layer_ratio.h"
#include "tests/unit_test.h"

#define NEAR(value, wanted) assert_true(fabs((value) - (double)(wanted)) <= 1e-9 * fabs((double)(wanted)))

// Two layers, 0.4 and 1 high, over a right triangle of area 1/2, and a tetrahedron of the given height on their end.
// The last prism has the volume 1/2, the tetrahedron a sixth of its height.
static CwStatus count(double height, int with_tet, CwLayerRatio ratio[2]) {
  double x[10][3] = {{0, 0, 0},   {1, 0, 0},   {0, 1, 0},   {0, 0, 0.4}, {1, 0, 0.4},
                     {0, 1, 0.4}, {0, 0, 1.4}, {1, 0, 1.4}, {0, 1, 1.4}, {0.3, 0.3, 1.4 + height}};
  int32_t tet[1][4] = {{6, 7, 8, 9}}, prism[2][6] = {{0, 1, 2, 3, 4, 5}, {3, 4, 5, 6, 7, 8}};
  int32_t triangle[1][3] = {{0, 2, 1}}, patch[1] = {1}, cell[1] = {with_tet};
  CwRegionMesh mesh = {.domain = "rotor",
                       .region = 1,
                       .cells.point_count = 10,
                       .cells.points = x,
                       .cells.tetrahedron_count = with_tet,
                       .cells.tetrahedra = tet,
                       .cells.prism_count = 2,
                       .cells.prisms = prism,
                       .cells.triangle_count = 1,
                       .cells.triangles = triangle,
                       .cells.triangle_patch = patch,
                       .cells.triangle_cell = cell};
  return cw_layer_ratio(&mesh, 2, 2, ratio);
}

static void ratio_of_the_volumes(void **state) {
  CwLayerRatio ratio[2] = {0};
  assert_int_equal(count(3, 1, ratio), CW_OK); // equal
  NEAR(ratio[1].greatest, 1);
  assert_int_equal(ratio[1].bin[0], 1);
  assert_int_equal(count(1.5, 1, ratio), CW_OK); // the prism is twice the tetrahedron
  NEAR(ratio[1].greatest, 2);
  assert_int_equal(ratio[1].bin[7], 1); // 2^(7/8) to 2
  assert_int_equal(ratio[1].thick_over_fair + ratio[1].thin_over_fair, 0);
  assert_int_equal(count(0.5, 1, ratio), CW_OK); // 6 times
  assert_int_equal(count(15, 1, ratio), CW_OK);  // a fifth
  assert_int_equal(ratio[1].thick_over_fair, 1);
  assert_int_equal(ratio[1].thin_over_fair, 1);
  assert_int_equal(ratio[1].over_most, 0);
  assert_int_equal(count(36, 1, ratio), CW_OK); // a twelfth
  assert_int_equal(ratio[1].thin_over_fair, 2);
  assert_int_equal(ratio[1].over_most, 1);
  NEAR(ratio[1].greatest, 12);
  NEAR(ratio[1].greatest_at[0], 1.0 / 3);
  NEAR(ratio[1].greatest_at[2], 1.4);
  assert_int_equal(ratio[1].faces, 5);
  assert_int_equal(ratio[0].faces, 0);
}

static void weight_of_the_face(void **state) {
  // The prism's centre is 0.5 below the face, the tetrahedron's a quarter of its height above: the lesser share is 0.05
  // where that is 9.5, with a height of 38, or 0.5 / 19, with one of 2 / 19.
  const struct {
    double height;
    int small;
  } cases[] = {{2, 0}, {37.9, 0}, {38.1, 1}, {2.0 / 18.9, 0}, {2.0 / 19.1, 1}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    CwLayerRatio ratio[2] = {0};
    assert_int_equal(count(cases[i].height, 1, ratio), CW_OK);
    assert_int_equal(ratio[1].small_weight, cases[i].small);
  }
}

static void sums_and_quantiles(void **state) {
  CwLayerRatio one[2] = {0}, sum = {0};
  NEAR(cw_layer_ratio_quantile(&sum, 0.95) + 1, 1);
  for (int i = 0; i < 19; i++) assert_int_equal(count(1.5 / 1.01, 1, one), CW_OK); // 2.02, in the bin up to 2^(9/8)
  assert_int_equal(count(15, 1, one), CW_OK);
  cw_layer_ratio_add(&sum, &one[1]);
  cw_layer_ratio_add(&sum, &one[1]);
  assert_int_equal(sum.faces, 40);
  assert_int_equal(sum.thin_over_fair, 2);
  NEAR(sum.greatest, 5);
  NEAR(cw_layer_ratio_quantile(&sum, 0.95), exp2(9.0 / 8));
  NEAR(cw_layer_ratio_quantile(&sum, 0.96), 5);
  NEAR(cw_layer_ratio_quantile(&sum, 1), 5);
}

static void a_bare_end_is_an_error(void **state) {
  CwLayerRatio ratio[2] = {0};
  assert_int_equal(count(0.9, 0, ratio), CW_ERR_FAULT);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(ratio_of_the_volumes), cmocka_unit_test(weight_of_the_face),
                                     cmocka_unit_test(sums_and_quantiles), cmocka_unit_test(a_bare_end_is_an_error)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
