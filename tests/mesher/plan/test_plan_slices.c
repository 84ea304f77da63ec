// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>

#include "mesher/plan/plan_slices.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

enum { STEPS = CW_SLICE_STEPS, FEW = 9, STEPS_FEW = FEW * STEPS };

// A slice costs the square of the steps that it is off an even one.
static void cost_of_lengths(double slice_cost[CW_SLICE_MOST + 1]) {
  for (int n = 0; n <= CW_SLICE_MOST; n++) slice_cost[n] = (n - STEPS) * (n - STEPS);
}

// Of three slices the first plane cannot stand at its even place, nor a step to either side: it moves by two, and the
// other two slices are one step off each.
static void a_plane_moves_off_a_place_that_costs(void **state) {
  double slice_cost[CW_SLICE_MOST + 1], place_cost[3 * STEPS + 1] = {0}, cost;
  int32_t step[4];
  cost_of_lengths(slice_cost);
  for (int s = STEPS - 1; s <= STEPS + 1; s++) place_cost[s] = 100;
  assert_int_equal(cw_slices_place(3, slice_cost, place_cost, step, &cost), CW_OK);
  assert_near(cost, 4 + 1 + 1, 0);
  assert_int_equal(step[0], 0);
  assert_int_equal(abs(step[1] - STEPS), 2);
  assert_int_equal(step[2] - step[1], step[3] - step[2]);
  assert_int_equal(step[3], 3 * STEPS);
}

// No plane fits within the two slices in the middle of four: one as long as both reaches over them.
static void a_slice_reaches_over_what_no_plane_fits(void **state) {
  double slice_cost[CW_SLICE_MOST + 1], place_cost[4 * STEPS + 1] = {0}, cost;
  int32_t step[5];
  cost_of_lengths(slice_cost);
  for (int s = STEPS + 1; s < 3 * STEPS; s++) place_cost[s] = 1e6;
  assert_int_equal(cw_slices_place(4, slice_cost, place_cost, step, &cost), CW_OK);
  assert_true(cost < 1e6);
  int longest = 0;
  for (int i = 1; i <= 4; i++) longest = step[i] - step[i - 1] > longest ? step[i] - step[i - 1] : longest;
  assert_int_equal(longest, 2 * STEPS);
}

static void one_slice_is_all(void **state) {
  double slice_cost[CW_SLICE_MOST + 1], place_cost[STEPS + 1] = {0}, cost;
  int32_t step[2];
  cost_of_lengths(slice_cost);
  slice_cost[STEPS] = 7;
  assert_int_equal(cw_slices_place(1, slice_cost, place_cost, step, &cost), CW_OK);
  assert_near(cost, 7, 0);
  assert_int_equal(step[0], 0);
  assert_int_equal(step[1], STEPS);
}

// More than there are pairs of planes and steps in 32 bits.
static void thousands_of_slices_are_even_where_that_costs_least(void **state) {
  const int32_t slices = 8000;
  double slice_cost[CW_SLICE_MOST + 1], *place_cost = calloc((size_t)slices * STEPS + 1, sizeof *place_cost), cost;
  int32_t *step = calloc((size_t)slices + 1, sizeof *step), uneven = 0;
  cost_of_lengths(slice_cost);
  assert_int_equal(cw_slices_place(slices, slice_cost, place_cost, step, &cost), CW_OK);
  assert_near(cost, 0, 0);
  for (int32_t i = 0; i <= slices; i++) uneven += step[i] != i * STEPS;
  assert_int_equal(uneven, 0);
  free(step);
  free(place_cost);
}

// What the best of all ways costs, by the whole table.
static double least_of_all(int32_t slices, const double *slice_cost, const double *place_cost) {
  static double least[FEW + 1][STEPS_FEW + 1];
  for (int32_t i = 0; i <= slices; i++) {
    for (int32_t s = 0; s <= slices * STEPS; s++) {
      least[i][s] = i == 0 && s == 0 ? 0 : INFINITY;
      if (i == 0 || (i == slices ? s < slices * STEPS : abs(s - i * STEPS) > 3 * STEPS)) continue;
      for (int32_t b = 0; b <= s; b++) {
        if (s - b < STEPS / 2 || s - b > 3 * STEPS) continue;
        least[i][s] = fmin(least[i][s], least[i - 1][b] + slice_cost[s - b] + place_cost[s]);
      }
    }
  }
  return least[slices][slices * STEPS];
}

// The planes that are found cost what is told, and as little as can be.
static void planes_cost_as_little_as_can_be(void **state) {
  uint64_t random = 1;
  for (int32_t slices = 1; slices <= FEW; slices++) {
    for (int k = 0; k < 5; k++) {
      double slice_cost[CW_SLICE_MOST + 1], place_cost[STEPS_FEW + 1], cost, sum = 0;
      int32_t step[FEW + 1];
      for (int n = 0; n <= CW_SLICE_MOST; n++) slice_cost[n] = (k % 2 ? 1 : 0.01 * n) * draw(&random);
      for (int32_t s = 0; s <= slices * STEPS; s++) place_cost[s] = 3 * draw(&random);
      assert_int_equal(cw_slices_place(slices, slice_cost, place_cost, step, &cost), CW_OK);
      assert_near(cost, least_of_all(slices, slice_cost, place_cost), 0);
      assert_int_equal(step[0], 0);
      assert_int_equal(step[slices], slices * STEPS);
      for (int32_t i = 1; i <= slices; i++) {
        assert_true(step[i] - step[i - 1] >= STEPS / 2 && step[i] - step[i - 1] <= CW_SLICE_MOST);
        sum = sum + slice_cost[step[i] - step[i - 1]] + place_cost[step[i]];
      }
      assert_near(sum, cost, 0);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_plane_moves_off_a_place_that_costs),
      cmocka_unit_test(a_slice_reaches_over_what_no_plane_fits),
      cmocka_unit_test(one_slice_is_all),
      cmocka_unit_test(thousands_of_slices_are_even_where_that_costs_least),
      cmocka_unit_test(planes_cost_as_little_as_can_be),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
