// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "mesher/region/layer_ratio.h"

// Two layers, 0.4 and 1 high, over a right triangle, and a tetrahedron of the given height on their end.
static CwStatus count(double height, int with_tet, CwRatioWall wall, CwLayerRatio ratio[2]) {
  double x[10][3] = {{0, 0, 0},   {1, 0, 0},   {0, 1, 0},   {0, 0, 0.4}, {1, 0, 0.4},
                     {0, 1, 0.4}, {0, 0, 1.4}, {1, 0, 1.4}, {0, 1, 1.4}, {0.3, 0.3, 1.4 + height}};
  int32_t tet[1][4] = {{6, 7, 8, 9}}, prism[2][6] = {{0, 1, 2, 3, 4, 5}, {3, 4, 5, 6, 7, 8}};
  int32_t triangle[1][3] = {{0, 2, 1}}, patch[1] = {1}, cell[1] = {with_tet};
  CwRegionMesh mesh = {.domain = "rotor",
                       .region = 1,
                       .point_count = 10,
                       .x = x,
                       .tetrahedron_count = with_tet,
                       .tetrahedron = tet,
                       .prism_count = 2,
                       .prism = prism,
                       .triangle_count = 1,
                       .triangle = triangle,
                       .triangle_patch = patch,
                       .triangle_cell = cell};
  return cw_layer_ratio(&mesh, 2, &wall, 2, ratio);
}

static const CwRatioWall WALL = {.first = 0.4, .last = 0.48, .made = 1};

static void last_layer_over_the_tetrahedron(void **state) {
  CwLayerRatio ratio[2] = {0};
  assert_int_equal(count(0.9, 1, WALL, ratio), CW_OK); // 1 / 0.9 = 1.11: above 1, up to 1.25
  assert_int_equal(ratio[1].bin[4], 1);
  assert_int_equal(count(5, 1, WALL, ratio), CW_OK); // 0.2
  assert_int_equal(ratio[1].bin[0], 1);
  assert_int_equal(count(0.4, 1, WALL, ratio), CW_OK); // 2.5
  assert_int_equal(ratio[1].bin[CW_RATIO_BINS - 1], 1);
  for (int b = 0; b < CW_RATIO_BINS; b++) assert_int_equal(ratio[0].bin[b], 0);
}

static void layers_that_reach_the_tetrahedron(void **state) {
  CwLayerRatio ratio[2] = {0};
  CwRatioWall cramped = WALL, thick = WALL, even = WALL, narrow = WALL;
  cramped.cramped = 1;
  thick.first = 1.4;
  even.last = 0.4;
  narrow.made = 1.1;                                   // by its height; its volume over the face is 1
  assert_int_equal(count(0.9, 1, WALL, ratio), CW_OK); // half of it is 0.45, below 0.48
  assert_int_equal(ratio[1].within, 1);
  assert_int_equal(ratio[1].fair_within, 1);
  assert_int_equal(count(1.8, 1, WALL, ratio), CW_OK); // 1 / 1.8 is fair, but by the case two layers would not do
  assert_int_equal(ratio[1].within, 1);
  assert_int_equal(count(0.4, 1, WALL, ratio), CW_OK); // two would do; made too tall
  assert_int_equal(ratio[1].within, 2);
  assert_int_equal(count(0.9, 1, thick, ratio), CW_OK);  // 1.4 is more than 1.35
  assert_int_equal(count(0.9, 1, even, ratio), CW_OK);   // 0.4 never comes to 0.45
  assert_int_equal(count(0.9, 1, narrow, ratio), CW_OK); // 0.48 / 1.1 neither
  assert_int_equal(count(0.9, 1, cramped, ratio), CW_OK);
  assert_int_equal(ratio[1].within, 2);
  assert_int_equal(ratio[1].fair_within, 1);
}

static void a_bare_end_is_an_error(void **state) {
  CwLayerRatio ratio[2] = {0};
  assert_int_equal(count(0.9, 0, WALL, ratio), CW_ERR_MESH);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(last_layer_over_the_tetrahedron),
                                     cmocka_unit_test(layers_that_reach_the_tetrahedron),
                                     cmocka_unit_test(a_bare_end_is_an_error)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
