// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/volute_tongue.h"

#include <math.h>
#include <string.h>

#include "geometry/volute_section.h"
#include "tests/draw.h"
#include "tests/geometry/paper_volute.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180, mm = 1e-3;

// At every level the nose's circle touches the spiral's level line and the plane x = x_i from inside the
// solid.
static void tongue_touches(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.tongue_gap = 7 * mm;
  CwVolute volute = designed_volute(&input);
  assert_near(volute.tip_radius, 109 * mm, 1e-9);
  double centre_x = volute.inner_wall_x - input.tongue_radius;
  for (int i = 0; i <= 10; i++) {
    double w = volute.side_level * i / 10 * (1 - 1e-9), y = cw_volute_nose_y(&volute, w), nearest = HUGE_VAL;
    for (int k = 0; k < 20000; k++) { // points of the level line
      double phi = volute.start_angle - 0.05 + k * 2e-5;
      CwVoluteSection s = cw_volute_section(&volute, phi);
      if (w > s.arc_radius) continue;
      double r = s.arc_centre + sqrt(s.arc_radius * s.arc_radius - w * w);
      nearest = fmin(nearest, hypot(r * cos(phi) - centre_x, r * sin(phi) - y));
    }
    assert_near(nearest, input.tongue_radius, 2e-7);
  }
  // Level curve and slope go on without a jump above the kink.
  double h = 1e-7, w = volute.side_level;
  assert_near((cw_volute_nose_y(&volute, w + h) - cw_volute_nose_y(&volute, w)) / h, volute.side_centre_slope, 0.01);
  assert_near((cw_volute_nose_y(&volute, w) - cw_volute_nose_y(&volute, w - h)) / h, volute.side_centre_slope, 0.01);
}

static CwVolute draw_volute(uint64_t *seed) {
  CwVoluteInput input = volute_of_paper();
  input.side_wall_angle = (10 + 20 * draw(seed)) * degree;
  input.tongue_radius = (1 + 1.5 * draw(seed)) * mm;
  input.angular_momentum = 0.8 + 0.3 * draw(seed);
  input.throat_area = NAN;
  input.outlet_diameter = NAN;
  return designed_volute(&input);
}

// Where the nose touches the wall's line, the circle on the wall's normal in plan touches the inner wall of the
// discharge too; at the middle that is the tip's angle, and lines beyond the kink begin where it does.
static void circles_touch_wall_and_discharge(void **state) {
  uint64_t seed = 42;
  for (int i = 0; i < 20; i++) {
    const CwVolute volute = draw_volute(&seed);
    const double k0 = volute.arc_half_angle, radius = volute.input.tongue_radius;
    assert_near(cw_volute_contact_angle(&volute, 0), volute.tip_angle, 1e-9);
    assert_near(cw_volute_contact_angle(&volute, 2 * k0), volute.start_angle, 0);
    for (int j = 0; j < 10; j++) {
      const double psi = k0 * (2 * draw(&seed) - 1), phi = cw_volute_contact_angle(&volute, psi), step = 1e-6;
      double centre[2], normal[2], x[3], ahead[3];
      assert_true(phi >= volute.start_angle && phi <= volute.tip_angle + 1e-9);
      assert_near(cw_volute_contact_angle(&volute, -psi), phi, 1e-12);
      cw_volute_contact_circle(&volute, phi, psi, centre, normal);
      cw_volute_wall_point(&volute, phi, psi, x, NULL, NULL);
      assert_near(hypot(normal[0], normal[1]), 1, 1e-12);
      assert_near(hypot(centre[0] - x[0], centre[1] - x[1]), radius, 1e-12);
      assert_true(hypot(centre[0], centre[1]) > hypot(x[0], x[1])); // out of the fluid
      assert_near(centre[0] + radius, volute.inner_wall_x, 1e-12);
      assert_near(cw_volute_nose_y(&volute, fabs(x[2])), centre[1], 1e-9);
      // Square to the wall's line at this level.
      const CwVoluteSection s = cw_volute_section(&volute, phi + step);
      cw_volute_wall_point(&volute, phi + step, cw_volute_section_parameter(&volute, &s, fabs(x[2])), ahead, NULL,
                           NULL);
      assert_near((normal[0] * (ahead[0] - x[0]) + normal[1] * (ahead[1] - x[1])) / (step * hypot(x[0], x[1])), 0,
                  1e-4);
    }
  }
}

// The nose ends where the casing is as wide as it is high, and the spiral's wall crosses the throat behind a turn.
static void ends_of_nose_and_spiral(void **state) {
  uint64_t seed = 43;
  for (int i = 0; i < 20; i++) {
    const CwVolute volute = draw_volute(&seed);
    const double radius = volute.input.tongue_radius;
    for (int j = 0; j < 10; j++) {
      const double beta = -M_PI * draw(&seed), w = cw_volute_nose_height(&volute, beta);
      const double x = volute.inner_wall_x - radius + radius * cos(beta);
      const double y = cw_volute_nose_y(&volute, w) + radius * sin(beta);
      assert_near(w, volute.input.inlet_width / 2 + (hypot(x, y) - 0.102) * tan(volute.input.side_wall_angle), 1e-9);
      const double psi = volute.arc_half_angle * (2 * draw(&seed) - 1), phi = cw_volute_throat_angle(&volute, psi);
      double at[3];
      cw_volute_wall_point(&volute, phi, psi, at, NULL, NULL);
      assert_true(phi > 2 * M_PI && phi < 2.4 * M_PI);
      assert_near(at[1], volute.throat_y, 1e-9);
      assert_true(at[0] > volute.inner_wall_x);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(tongue_touches),
      cmocka_unit_test(circles_touch_wall_and_discharge),
      cmocka_unit_test(ends_of_nose_and_spiral),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
