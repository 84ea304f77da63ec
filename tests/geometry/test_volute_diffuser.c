// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/volute_diffuser.h"
#include "tests/unit_test.h"

// The paper's throat, 889.8 mm2: 1.5 of it is a circle of 41.2 mm, the next bore DN 50, with 3.54 m/s at 25 m3/h. With
// twice the flow DN 50 has 7.1 m/s; DN 65 would have an area ratio of 3.7.
static void bores_by_hand(void **state) {
  assert_near(cw_diffuser_bore(25 / 3600.0, 889.8e-6), 0.05, 1e-12);
  assert_near(cw_diffuser_bore(50 / 3600.0, 889.8e-6), 0.05, 1e-12);
  // 1200 mm2: at least 47.9 mm, DN 50 (ratio 1.64), 7.1 m/s; DN 65 has 2.77 and 4.2 m/s, DN 80 4.2: too wide.
  assert_near(cw_diffuser_bore(50 / 3600.0, 1200e-6), 0.065, 1e-12);
}

// Whatever flow and size: an area ratio from 1.5 to 3, and as slow as 4 m/s where the next bore stays within 3.
static void ratio_within_its_range(void **state) {
  for (double area = 1e-8; area < 10; area *= 1.73)
    for (double speed = 0.5; speed < 100; speed *= 1.61) {
      const double bore = cw_diffuser_bore(speed * area, area), ratio = M_PI / 4 * bore * bore / area;
      assert_true(ratio >= 1.5 - 1e-9 && ratio <= 3 + 1e-9);
      assert_true(ratio > 3 / 1.79 || speed / ratio <= 4 + 1e-9);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bores_by_hand),
      cmocka_unit_test(ratio_within_its_range),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
