// SPDX-License-Identifier: AGPL-3.0-or-later

#include <math.h>
#include <stdlib.h>

#include "mesher/size/size_grid.h"
#include "pipeline/vec.h"
#include "tests/unit_test.h"

static const double low[3] = {0, 0, 0}, high[3] = {10, 8, 6};

static void grid_covers_its_box_within_the_limit(void **state) {
  CwSizeGrid grid;
  assert_int_equal(cw_size_grid_make(low, high, 0.5, 1000000, &grid), CW_OK);
  assert_true(grid.spacing == 0.5);
  for (int k = 0; k < 3; k++) {
    assert_true(grid.low[k] <= low[k] - 0.5);
    assert_true(grid.low[k] + (grid.count[k] - 1) * grid.spacing >= high[k] + 0.5);
  }
  cw_size_grid_free(&grid);
  assert_int_equal(cw_size_grid_make(low, high, 0.01, 20000, &grid), CW_OK);
  int64_t nodes = (int64_t)grid.count[0] * grid.count[1] * grid.count[2];
  assert_true(nodes <= 20000 && nodes > 15000);
  cw_size_grid_free(&grid);
  assert_null(grid.value);
}

static void linear_values_come_back(void **state) {
  CwSizeGrid grid;
  assert_int_equal(cw_size_grid_make(low, high, 1, 1000000, &grid), CW_OK);
  for (int32_t k = 0, n = 0; k < grid.count[2]; k++) {
    for (int32_t j = 0; j < grid.count[1]; j++) {
      for (int32_t i = 0; i < grid.count[0]; i++) grid.value[n++] = (float)(1 + 2 * i + 3 * j + 5 * k);
    }
  }
  const double x[3] = {2.25, 3.5, 0.125}; // node (0, 0, 0) is (-1, -1, -1)
  assert_true(fabs(cw_size_grid_at(&grid, x) - (1 + 2 * 3.25 + 3 * 4.5 + 5 * 1.125)) < 1e-12);
  const double outside[3] = {-50, 3.5, 0.125};
  assert_true(fabs(cw_size_grid_at(&grid, outside) - (1 + 3 * 4.5 + 5 * 1.125)) < 1e-12);
  cw_size_grid_free(&grid);
}

// A plane and two points: everywhere the least of value + slope * distance, to the order of the spacing.
static void seeds_spread_with_the_slope(void **state) {
  const double slope = 0.3, seed[2][3] = {{2, 2, 2}, {8, 5, 4}}, value[2] = {1, 0.4};
  CwSizeGrid grid;
  assert_int_equal(cw_size_grid_make(low, high, 0.1, 10000000, &grid), CW_OK);
  for (int s = 0; s < 2; s++) cw_size_grid_seed(&grid, seed[s], value[s]);
  for (double y = 0; y <= 8; y += 0.1) {
    for (double z = 0; z <= 6; z += 0.1) {
      const double wall[3] = {0, y, z};
      cw_size_grid_seed(&grid, wall, 1.2);
    }
  }
  assert_int_equal(cw_size_grid_spread(&grid, slope, NULL), CW_OK);
  for (int s = 0; s < 2; s++) assert_true(cw_size_grid_at(&grid, seed[s]) <= value[s] + 1e-6);
  for (double z = 0.3; z < 6; z += 0.7) {
    for (double y = 0.2; y < 8; y += 0.7) {
      for (double x = 0.1; x < 10; x += 0.7) {
        const double p[3] = {x, y, z};
        double exact = fmin(1.2 + slope * x, fmin(value[0] + slope * cw_distance(p, seed[0]),
                                                  value[1] + slope * cw_distance(p, seed[1])));
        double got = cw_size_grid_at(&grid, p);
        assert_true(got > exact - slope * 0.1 * 2.1); // a seed holds within its cell
        assert_true(got < exact + slope * 0.1 * 3 + 0.04 * (exact - 0.4));
      }
    }
  }
  cw_size_grid_free(&grid);
}

// A wall of nodes that take no part, with a gap at its end: the field goes round it, and is set behind it all the same.
static void fields_keep_within(void **state) {
  CwSizeGrid grid;
  const double seed[3] = {1, 1, 3}, behind[3] = {9, 1, 3}, in_wall[3] = {5, 1, 3};
  assert_int_equal(cw_size_grid_make(low, high, 0.25, 1000000, &grid), CW_OK);
  size_t nodes = (size_t)grid.count[0] * (size_t)grid.count[1] * (size_t)grid.count[2];
  uint8_t *within = calloc(nodes, 1);
  assert_non_null(within);
  for (size_t n = 0; n < nodes; n++) {
    double x = grid.low[0] + (double)(n % (size_t)grid.count[0]) * grid.spacing;
    double y = grid.low[1] + (double)(n / (size_t)grid.count[0] % (size_t)grid.count[1]) * grid.spacing;
    within[n] = !(x > 4.4 && x < 5.6 && y < 6.9);
  }
  cw_size_grid_seed(&grid, seed, 1);
  assert_int_equal(cw_size_grid_spread(&grid, 0.5, within), CW_OK);
  double round = 1 + 0.5 * (hypot(3.5, 6) + 1 + hypot(3.5, 6)), at_behind = cw_size_grid_at(&grid, behind);
  assert_true(at_behind > round - 0.5 && at_behind < 1.1 * round + 0.3);
  double straight = 1 + 0.5 * 4;
  assert_true(cw_size_grid_at(&grid, in_wall) < straight + 0.6 && cw_size_grid_at(&grid, in_wall) > straight - 0.6);
  free(within);
  cw_size_grid_free(&grid);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(grid_covers_its_box_within_the_limit),
      cmocka_unit_test(linear_values_come_back),
      cmocka_unit_test(seeds_spread_with_the_slope),
      cmocka_unit_test(fields_keep_within),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
