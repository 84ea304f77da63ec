// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/wall_flow.h"

#include <math.h>

#include "tests/unit_test.h"

static const CwWaterWay way = {.radius = 0.1,
                               .blade_speed = 7,
                               .passage = {0.01, 0.03},
                               .blade_width = 0.008,
                               .behind_blades = 0.002,
                               .volute_speed = 6,
                               .volute_width = 0.015,
                               .neck_width = 0.012,
                               .suction_speed = 2,
                               .suction_diameter = 0.07,
                               .suction_width = 0.035,
                               .throat_speed = 12,
                               .throat_diameter = 0.02,
                               .discharge_speed = 3,
                               .discharge_diameter = 0.04};

static void check(const CwWallFlow *flow, CwAlong along, double speed, double length, double diameter, double width,
                  double before) {
  assert_near(flow[along].speed, speed, 1e-14);
  assert_near(flow[along].length, length, 1e-15);
  assert_near(flow[along].diameter, diameter, 1e-15);
  assert_near(flow[along].width, width, 1e-15);
  assert_near(flow[along].before, before, 1e-15);
}

// By hand: four times 10 x 30 over 80 between the blades; of 12 m/s at the throat and 3 at the end of a cone whose
// radius doubles, the mean of 12 / (1 + s)^2 over s is 6.
static void walls_have_the_flow_beside_them(void **state) {
  CwWallFlow flow[CW_ALONG_COUNT];
  cw_wall_flows(&way, flow);
  check(flow, CW_ALONG_BLADE, 7, 0.12, 0.015, 0.008, 0);
  check(flow, CW_ALONG_TRAILING_EDGE, 7, 0.12, 0.015, 0.008, 0.002);
  check(flow, CW_ALONG_NECK, 6, 0.3, 0.02, 0.012, 0);
  check(flow, CW_ALONG_VOLUTE, 6, 0.3, 0.02, 0.015, 0);
  check(flow, CW_ALONG_SUCTION, 2, 0.3, 0.07, 0.035, 0);
  check(flow, CW_ALONG_DIFFUSER, 6, 0.3, 0.02 * sqrt(2), 0.02, 0);
  check(flow, CW_ALONG_DISCHARGE, 3, 0.3, 0.04, 0.04, 0);
}

// A throat that is narrower than the wheel is wide is the narrowest place of spiral and neck.
static void a_small_throat_is_narrowest(void **state) {
  CwWaterWay small = way;
  CwWallFlow flow[CW_ALONG_COUNT];
  small.throat_diameter = 0.01;
  cw_wall_flows(&small, flow);
  assert_near(flow[CW_ALONG_VOLUTE].width, 0.01, 0);
  assert_near(flow[CW_ALONG_NECK].width, 0.01, 0);
  assert_near(flow[CW_ALONG_DIFFUSER].width, 0.01, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(walls_have_the_flow_beside_them),
                                     cmocka_unit_test(a_small_throat_is_narrowest)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
