// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>

#include "mesher/region/region_number.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static void chain_needs_two_colours(void **state) {
  const int32_t pair[3][2] = {{0, 1}, {1, 2}, {2, 3}};
  int32_t number[4], colour[4], colours;
  assert_int_equal(cw_region_numbers(4, 3, pair, number, colour, &colours), CW_OK);
  assert_int_equal(colours, 2);
  // Largest degree first: 1, then 2, 0, 3. Numbers by colour, then index.
  const int32_t wanted[4] = {3, 1, 4, 2};
  for (int r = 0; r < 4; r++) assert_int_equal(number[r], wanted[r]);
}

static void complete_graph_needs_as_many_colours_as_regions(void **state) {
  const int32_t pair[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  int32_t number[4], colours;
  assert_int_equal(cw_region_numbers(4, 6, pair, number, NULL, &colours), CW_OK);
  assert_int_equal(colours, 4);
}

static void neighbours_differ_and_smaller_colours_have_smaller_numbers(void **state) {
  enum { REGIONS = 60, PAIRS = 200 };
  uint64_t seed = 11;
  for (int trial = 0; trial < 50; trial++) {
    int32_t pair[PAIRS][2], number[REGIONS], colour[REGIONS], colours, seen[REGIONS + 1] = {0};
    for (int p = 0; p < PAIRS; p++) {
      pair[p][0] = draw_below(&seed, REGIONS - 1);
      pair[p][1] = pair[p][0] + 1 + draw_below(&seed, REGIONS - 1 - pair[p][0]);
    }
    assert_int_equal(cw_region_numbers(REGIONS, PAIRS, (const int32_t(*)[2])pair, number, colour, &colours), CW_OK);
    for (int p = 0; p < PAIRS; p++) {
      int32_t a = pair[p][0], b = pair[p][1];
      assert_int_not_equal(colour[a], colour[b]);
      assert_true((colour[a] < colour[b]) == (number[a] < number[b]));
    }
    for (int r = 0; r < REGIONS; r++) {
      assert_in_range(number[r], 1, REGIONS);
      assert_int_equal(seen[number[r]]++, 0);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(chain_needs_two_colours),
      cmocka_unit_test(complete_graph_needs_as_many_colours_as_regions),
      cmocka_unit_test(neighbours_differ_and_smaller_colours_have_smaller_numbers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
