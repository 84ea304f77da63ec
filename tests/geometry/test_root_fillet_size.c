// SPDX-License-Identifier: AGPL-3.0-or-later
// Angle of the crease and tangent length of a root fillet, by hand and against a ball that touches blade and wall.
#include "geometry/root_fillet_size.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

// A blade that leans by `lean` over its height towards the side meets the wall there at the angle whose cotangent that
// is, at 45 degrees at least; the other side's angle makes 180 with it.
static void angles_of_a_leaning_blade(void **state) {
  uint64_t seed = 1;
  for (int i = 0; i < 200; i++) {
    const double turn = 2 * M_PI * draw(&seed), side = 2 * M_PI * draw(&seed), tilt = 0.75 * draw(&seed);
    const CwFilletPlace place = {.lean = {tan(tilt) * cos(turn), tan(tilt) * sin(turn)}};
    const double towards = tan(tilt) * cos(turn - side), m = cos(side), t = sin(side);
    assert_near(cw_root_fillet_angle(&place, m, t), M_PI / 2 - atan(towards), 1e-12);
    assert_near(cw_root_fillet_angle(&place, m, t) + cw_root_fillet_angle(&place, -m, -t), M_PI, 1e-12);
  }
  const CwFilletPlace flat = {.lean = {5, 0}};
  assert_near(cw_root_fillet_angle(&flat, 1, 0), M_PI / 4, 1e-15);
  assert_near(cw_root_fillet_angle(&flat, -1, 0), M_PI / 2 + atan(5), 1e-12);
}

// A ball of the radius R, at the length L along each of both, is R away from both: L sin(alpha) = R (1 + cos(alpha)).
// It holds on the first 0.85 of the blade; at its end L is 0.4 of the room before the interface where that is less.
static void lengths_along_the_blade(void **state) {
  uint64_t seed = 2;
  int narrow = 0;
  for (int i = 0; i < 200; i++) {
    const double alpha = (45 + 120 * draw(&seed)) * M_PI / 180, radius = 1e-3 + 4e-3 * draw(&seed);
    const double room = 0.4 * (0.01 * draw(&seed) + 1e-3), start = 0.3 * draw(&seed) - 0.1;
    const CwDesign design = {
        .root_fillet_radius = radius, .outlet_diameter = 0.3, .interface_radius = 0.15 + room / 0.4};
    const CwBladeSection section = {.start = start};
    double before = INFINITY;
    for (int k = -2; k <= 42; k++) {
      const double share = k / 40.0, q = start + share * (1 - start);
      const double length = cw_root_fillet_length(&design, &section, q, alpha);
      if (share < 0.85) assert_near(length * sin(alpha), radius * (1 + cos(alpha)), 1e-12);
      if (share >= 1) assert_near(length, fmin(radius / tan(alpha / 2), room), 1e-12);
      assert_true(length <= before + 1e-15);
      before = length;
    }
    narrow += room < radius / tan(alpha / 2);
  }
  assert_true(narrow > 20 && narrow < 180);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(angles_of_a_leaning_blade),
      cmocka_unit_test(lengths_along_the_blade),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
