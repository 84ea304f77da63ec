// SPDX-License-Identifier: AGPL-3.0-or-later
// The grid of directions: unit vectors, neighbours near one another, across the end of the half turn too.
#include <math.h>

#include "mesher/plan/plan_directions.h"
#include "tests/unit_test.h"

static double cosine(int32_t a, int32_t b) {
  double n[3], m[3];
  cw_direction(a, n);
  cw_direction(b, m);
  return n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
}

static void directions_are_units_and_differ(void **state) {
  for (int32_t d = 0; d < CW_DIRECTIONS; d++) {
    assert_true(fabs(cosine(d, d) - 1) < 1e-14);
    for (int32_t e = 0; e < d; e += 7) assert_true(fabs(cosine(d, e)) < 1 - 1e-6);
  }
}

static void turns_and_tilts_lead_to_neighbours(void **state) {
  for (int32_t d = 0; d < CW_ALONG_AXIS; d++) {
    int32_t turn = cw_direction_turn(d), tilt = cw_direction_tilt(d);
    assert_int_equal(cw_direction_at(turn, tilt), d);
    for (int step = -1; step <= 1; step += 2) {
      assert_true(fabs(cosine(d, cw_direction_at(turn + step, tilt))) > cos(1.51 * M_PI / 180));
      int32_t beside = cw_direction_at(turn, tilt + step);
      if (beside >= 0)
        assert_true(fabs(cosine(d, beside)) > cos(0.101));
      else
        assert_int_equal(tilt, step * CW_TILTS);
    }
    // Half a turn on it is the same plane.
    assert_int_equal(cw_direction_at(turn + CW_TURNS, -tilt), d);
    assert_int_equal(cw_direction_at(turn - CW_TURNS, -tilt), d);
  }
}

static void upright_planes_hold_the_axis(void **state) {
  int upright = 0;
  for (int32_t d = 0; d < CW_DIRECTIONS; d++) {
    double n[3];
    cw_direction(d, n);
    assert_int_equal(cw_direction_is_upright(d), fabs(n[2]) < 1e-12);
    upright += cw_direction_is_upright(d);
  }
  assert_int_equal(upright, CW_TURNS);
  assert_true(fabs(fabs(cosine(CW_ALONG_AXIS, cw_direction_at(3, 4))) - sin(0.4)) < 1e-12);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(directions_are_units_and_differ),
                                     cmocka_unit_test(turns_and_tilts_lead_to_neighbours),
                                     cmocka_unit_test(upright_planes_hold_the_axis)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
