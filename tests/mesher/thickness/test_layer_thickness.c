// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/thickness/layer_thickness.h"
#include "tests/unit_test.h"

// y+ = 1 in water (nu = 1e-6 m2/s), worked with a pocket calculator.
static void first_heights_of_the_walls_of_a_pump(void **state) {
  assert_near(cw_first_height(1.0, 7.8, 0.12, 1e-6, 0), 3.0e-6, 0.05e-6);  // blade
  assert_near(cw_first_height(1.0, 5.85, 0.05, 1e-6, 0), 3.7e-6, 0.05e-6); // leading edge
  assert_near(cw_first_height(1.0, 7.0, 0.3, 1e-6, 0), 3.6e-6, 0.1e-6);    // volute
  assert_near(cw_first_height(1.0, 15.2, 0.1, 1e-6, 0), 1.6e-6, 0.05e-6);  // open edge
  assert_near(cw_first_height(1.0, 1.6, 0.37, 1e-6, 0), 14e-6, 0.5e-6);    // inlet pipe
  assert_near(cw_first_height(1.0, 3.5, 0.25, 1e-6, 0), 6.6e-6, 0.1e-6);   // discharge
}

static void cell_centred_is_twice_and_y_plus_is_linear(void **state) {
  double y = cw_first_height(1.0, 7.8, 0.12, 1e-6, 0);
  assert_near(cw_first_height(1.0, 7.8, 0.12, 1e-6, 1), 2.0 * y, 1e-18);
  assert_near(cw_first_height(30.0, 7.8, 0.12, 1e-6, 0), 30.0 * y, 1e-16);
}

static void thickness_by_hand(void **state) {
  assert_near(cw_layer_thickness(1.0, 3, 2.0), 7.0, 0.0); // 1 + 2 + 4
  assert_near(cw_layer_thickness(0.5, 4, 1.0), 2.0, 0.0);
  // 18 layers from 5 um at 1.194: 0.6 mm
  assert_near(cw_layer_thickness(5e-6, 18, 1.194), 0.6e-3, 0.005e-3);
}

static void holds_the_first_height_and_solves_growth(void **state) {
  double f[4];
  assert_near(cw_layer_fractions(7.0, 1.0, 3, 3.0, f), 1.0, 0.0); // growth 2
  assert_near(f[0], 0.0, 0.0);
  assert_near(f[1], 1.0 / 7.0, 1e-14);
  assert_near(f[2], 3.0 / 7.0, 1e-14);
  assert_near(f[3], 1.0, 0.0);
}

static void growth_at_its_limit_raises_the_first_height(void **state) {
  double f[4];
  assert_near(cw_layer_fractions(14.0, 1.0, 3, 2.0, f), 2.0, 1e-14); // 2 + 4 + 8
  assert_near(f[1], 2.0 / 14.0, 1e-15);
  assert_near(f[2], 6.0 / 14.0, 1e-15);
}

static void a_short_column_gives_up_its_outer_layers(void **state) {
  double f[5];
  assert_near(cw_layer_fractions(4.0, 1.0, 4, 1.2, f), 1.0, 0.0); // just even
  for (int k = 0; k <= 4; k++) assert_near(f[k], 0.25 * k, 1e-14);
  // 1 + 0.8 + 0.64 + 0.512 = 2.952
  assert_near(cw_layer_fractions(2.952, 1.0, 4, 1.2, f), 1.0, 0.0);
  assert_near(f[1], 1.0 / 2.952, 1e-14);
  assert_near(f[2], 1.8 / 2.952, 1e-14);
  assert_near(f[3], 2.44 / 2.952, 1e-14);
  // 1 + 0.6 + 0.36 + 0.216 = 2.176 is the least that holds it: half of that halves every layer.
  assert_near(cw_layer_lowest(4), 2.176, 1e-14);
  assert_near(cw_layer_fractions(2.176, 1.0, 4, 1.2, f), 1.0, 1e-14);
  assert_near(cw_layer_fractions(2.176 / 2, 1.0, 4, 1.2, f), 0.5, 1e-14);
  assert_near(f[1], 1.0 / 2.176, 1e-14);
}

// Of up to six layers each may be 0.6 of the one before it, so that the sixth is 0.078 of the first; of more the last.
static void last_layers_stay_a_part_of_the_first(void **state) {
  double f[31], six = pow(0.6, 5);
  for (int count = 1; count <= 30; ++count) {
    const double growth = cw_layer_growth_least(count);
    if (count <= 6)
      assert_near(growth, 0.6, 1e-15);
    else
      assert_near(pow(growth, count - 1), six, 1e-14);
    cw_layer_fractions(1.0, 1.0, count, 1.2, f); // far too short
    if (count > 6) assert_near((f[count] - f[count - 1]) / f[1], six, 1e-12);
  }
}

static void one_layer_is_the_whole_column(void **state) {
  double f[2];
  assert_near(cw_layer_fractions(3.0, 1.0, 1, 1.2, f), 3.0, 0.0);
  assert_near(f[0], 0.0, 0.0);
  assert_near(f[1], 1.0, 0.0);
}

// Over many thicknesses: strictly growing, first height as returned, ratio of successive layers one number <=
// limit.
static void fractions_hold_their_rules_at_all_thickness(void **state) {
  double f[31];
  for (int count = 2; count <= 30; count += 7) {
    for (double thickness = 1e-6; thickness < 2e-2; thickness *= 1.13) {
      double first = cw_layer_fractions(thickness, 3e-6, count, 1.25, f);
      assert_near(f[1] * thickness, first, 1e-12 * thickness);
      assert_near(cw_layer_last(thickness, 3e-6, count, 1.25), 1 - f[count - 1], 1e-12);
      double ratio = (f[2] - f[1]) / f[1];
      assert_true(ratio <= 1.25 * (1 + 1e-9) && ratio >= cw_layer_growth_least(count) - 1e-9);
      for (int k = 1; k < count; k++) {
        assert_true(f[k + 1] > f[k]);
        assert_near((f[k + 1] - f[k]) / (f[k] - f[k - 1]), ratio, 1e-6);
      }
      if (ratio < 1.25 * (1 - 1e-9) && ratio > cw_layer_growth_least(count) * (1 + 1e-9))
        assert_near(first, 3e-6, 1e-20);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(first_heights_of_the_walls_of_a_pump),
      cmocka_unit_test(cell_centred_is_twice_and_y_plus_is_linear),
      cmocka_unit_test(thickness_by_hand),
      cmocka_unit_test(holds_the_first_height_and_solves_growth),
      cmocka_unit_test(growth_at_its_limit_raises_the_first_height),
      cmocka_unit_test(a_short_column_gives_up_its_outer_layers),
      cmocka_unit_test(last_layers_stay_a_part_of_the_first),
      cmocka_unit_test(one_layer_is_the_whole_column),
      cmocka_unit_test(fractions_hold_their_rules_at_all_thickness),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
