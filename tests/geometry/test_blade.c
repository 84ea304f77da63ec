// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/blade.h"
#include "geometry/hydraulic_design.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;
static CwDesign design;
static CwMeridian meridian;
static CwBladeSection section;

static int setup(void **state) {
  const CwCase table = paper();
  design = design_of(&table);
  return cw_meridian_make(&design, &meridian) || cw_blade_section(&design, &meridian, 0.5, &section);
}

// A logarithmic spiral wraps by the integral of dm/r over tan beta: the integral by chords.
static void spiral(void **state) {
  const double angle = 33 * degree, beta[3] = {angle, angle, angle};
  double sum = 0, last[2], x[2];
  cw_meridian_blade_point(&meridian, 0.5, 0, last, NULL);
  for (int i = 1; i <= 20000; i++) {
    cw_meridian_blade_point(&meridian, 0.5, i / 20000.0, x, NULL);
    sum += hypot(x[0] - last[0], x[1] - last[1]) / (0.5 * (x[0] + last[0]));
    last[0] = x[0];
    last[1] = x[1];
  }
  assert_near(cw_blade_wrap(&meridian, 0.5, beta), sum / tan(angle), 1e-7);
}

static void wrap_closes(void **state) {
  assert_near(cw_blade_theta(&section, 0), 71 * degree, 1e-8);
  assert_near(cw_blade_theta(&section, 1), 0, 1e-12);
  assert_near(cw_blade_beta(&section, 1), design.outlet_blade_angle, 1e-12);
  // theta falls with the slope of the law: d theta / dq = -|M'| / (r tan beta).
  double x[2], dx[2];
  cw_meridian_blade_point(&meridian, 0.5, 0.37, x, dx);
  const double slope = (cw_blade_theta(&section, 0.371) - cw_blade_theta(&section, 0.369)) / 0.002;
  assert_near(slope, -hypot(dx[0], dx[1]) / (x[0] * tan(cw_blade_beta(&section, 0.37))), 1e-5);
}

// Thickness across the blade, measured between the sides: r d theta sin beta where the offset is tangential.
static void thickness(void **state) {
  for (double q = 0.4; q <= 1; q += 0.1) {
    double x[2];
    cw_meridian_blade_point(&meridian, 0.5, q, x, NULL);
    const CwBladePoint p = cw_blade_side(&section, CW_BLADE_PRESSURE, q),
                       s = cw_blade_side(&section, CW_BLADE_SUCTION, q);
    assert_near(p.q, q, 1e-12);
    assert_near((p.theta - s.theta) * x[0] * sin(cw_blade_beta(&section, q)), 2 * cw_blade_half_thickness(&section, q),
                1e-12);
  }
  assert_near(cw_blade_half_thickness(&section, section.nose), design.leading_edge_thickness / 2, 1e-12);
  assert_near(cw_blade_half_thickness(&section, 0.45), design.blade_thickness / 2, 1e-12);
  assert_near(cw_blade_half_thickness(&section, 1), design.trailing_edge_thickness / 2, 1e-12);
}

// The ellipse meets the sides in points and begins at the mean line's end.
static void nose(void **state) {
  const CwBladePoint tip = cw_blade_leading_edge(&section, 0);
  assert_near(tip.q, 0, 1e-15);
  assert_near(tip.theta, 71 * degree, 1e-8);
  for (int side = 0; side < 2; side++) {
    const CwBladePoint a = cw_blade_leading_edge(&section, side ? -M_PI / 2 : M_PI / 2);
    const CwBladePoint b = cw_blade_side(&section, side ? CW_BLADE_SUCTION : CW_BLADE_PRESSURE, section.nose);
    assert_near(a.q, b.q, 1e-12);
    assert_near(a.theta, b.theta, 1e-12);
  }
}

// In the plane that touches the D2 cylinder: the facet has the asked length, and legs of equal length.
static void bevel(void **state) {
  const double facet = design.trailing_edge_bevel, q = cw_blade_bevel_begin(&section, CW_EDGE_BEVELLED, facet);
  const double end = cw_blade_bevel_theta(&section, q);
  const CwBladePoint begin = cw_blade_side(&section, CW_BLADE_SUCTION, q),
                     corner = cw_blade_side(&section, CW_BLADE_SUCTION, 1);
  double x[2], dx[2];
  cw_meridian_blade_point(&meridian, 0.5, 1, x, dx);
  const double dm = (1 - q) * hypot(dx[0], dx[1]);
  assert_near(hypot(dm, (begin.theta - corner.theta) * x[0]), (end - corner.theta) * x[0], 1e-12);
  // Curvature of the side and of the cylinder makes a little difference to the flat triangle.
  assert_near(hypot(dm, (end - begin.theta) * x[0]), facet, 0.05 * facet);
  // The balanced facet is as long as what is left of the cut.
  const double balanced = cw_blade_usual_bevel(CW_EDGE_BEVELLED, 2e-3, 36 * degree),
               leg = balanced / (2 * sin(18 * degree));
  assert_near(2e-3 / sin(36 * degree) - leg, balanced, 1e-15);
  for (CwTrailingEdge edge = CW_EDGE_BEVELLED; edge <= CW_EDGE_SHARP; edge++) {
    const double longest = cw_blade_longest_bevel(&section, edge), earliest = cw_blade_bevel_earliest(edge);
    assert_true(cw_blade_bevel_begin(&section, edge, longest) > earliest);
    assert_true(cw_blade_bevel_begin(&section, edge, 1.02 * longest) < earliest);
  }
}

// Of blades without thickness the width is the pitch, r dtheta sin beta, where that is least; a splitter takes its
// share.
static void clearance(void **state) {
  CwDesign thin = design;
  thin.leading_edge_thickness = thin.blade_thickness = thin.trailing_edge_thickness = 1e-7;
  double least = INFINITY, behind = INFINITY, found;
  for (int wall = 0; wall < 2; wall++) {
    CwBladeSection on;
    assert_int_equal(cw_blade_section(&thin, &meridian, wall, &on), CW_OK);
    for (int i = 0; i <= 1000; i++) {
      double x[2];
      cw_meridian_blade_point(&meridian, wall, i / 1000.0, x, NULL);
      const double width = 2 * M_PI / 6 * x[0] * sin(cw_blade_beta(&on, i / 1000.0));
      least = fmin(least, width);
      if (i >= 400) behind = fmin(behind, width);
    }
  }
  assert_int_equal(cw_blade_clearance(&thin, &meridian, &found), CW_OK);
  assert_near(found, least, 2e-4 * least);
  thin.splitter_start = 0.4;
  thin.splitter_position = 0.35;
  assert_int_equal(cw_blade_clearance(&thin, &meridian, &found), CW_OK);
  assert_near(found, 0.35 * behind, 2e-4 * behind);
  // Thicker than the pitch: they overlap.
  thin.blade_thickness = 0.06;
  assert_int_equal(cw_blade_clearance(&thin, &meridian, &found), CW_OK);
  assert_true(found < 0);
}

// A cylindrical blade is one curve in plan: where others of its sections have a radius of mid-span's, they have its
// angle and its tangent there; before that, both go on without a step.
static void cylindrical_sections_lie_over_each_other(void **state) {
  CwDesign flat = design;
  CwBladeSection middle, wall;
  flat.blade_form = CW_BLADE_CYLINDRICAL;
  assert_int_equal(cw_blade_section(&flat, &meridian, 0.5, &middle), CW_OK);
  for (int side = 0; side < 2; side++) {
    double last_theta = NAN, last_r = NAN;
    int before = 0;
    assert_int_equal(cw_blade_section(&flat, &meridian, side, &wall), CW_OK);
    for (int i = 0; i <= 200; i++) {
      const double q = i / 200.0, theta = cw_blade_theta(&wall, q);
      double x[2], dx[2], y[2], dy[2], low = 0, high = 1;
      cw_meridian_blade_point(&meridian, side, q, x, dx);
      // d theta / dr = -1 / (r tan beta'), beta' the angle in plan: no step anywhere
      const double plan = tan(cw_blade_beta(&wall, q)) * dx[0] / hypot(dx[0], dx[1]);
      if (i > 0 && dx[0] > 0.1 * hypot(dx[0], dx[1]))
        assert_near(last_theta - theta, (x[0] - last_r) / (0.5 * (x[0] + last_r) * plan),
                    0.02 * (x[0] - last_r) / (x[0] * plan));
      last_theta = theta, last_r = x[0];
      cw_meridian_blade_point(&meridian, 0.5, 0, y, dy);
      before += x[0] < y[0];
      if (x[0] <= y[0]) continue;
      for (int k = 0; k < 60; k++) {
        const double mid = 0.5 * (low + high);
        cw_meridian_blade_point(&meridian, 0.5, mid, y, dy);
        *(y[0] < x[0] ? &low : &high) = mid;
      }
      assert_near(theta, cw_blade_theta(&middle, low), 1e-6);
      assert_near(plan, tan(cw_blade_beta(&middle, low)) * dy[0] / hypot(dy[0], dy[1]), 1e-6);
    }
    assert_int_equal(before > 0, side == 0);
  }
}

// From the thickest place on, the sides of a thick blade turn into a rounded trailing edge one way: along each of them
// the angle to the mean line keeps its sign.
static void thick_rounded_sides_do_not_swing(void **state) {
  CwDesign thick = design;
  CwBladeSection rounded;
  thick.trailing_edge = CW_EDGE_ROUNDED;
  thick.blade_thickness = 0.04 * design.outlet_diameter;
  thick.trailing_edge_thickness = 0.02 * design.outlet_diameter;
  assert_int_equal(cw_blade_section(&thick, &meridian, 0.5, &rounded), CW_OK);
  assert_true(rounded.end < 0.98);
  for (int side = CW_BLADE_PRESSURE; side <= CW_BLADE_SUCTION; side++)
    for (int i = 1; i < 50; i++) {
      const double p = rounded.thickest_at + i / 50.0 * (rounded.end - rounded.thickest_at), step = 1e-4;
      const CwBladePoint a = cw_blade_side(&rounded, side, p - step), b = cw_blade_side(&rounded, side, p + step);
      double x[2], dx[2];
      cw_meridian_blade_point(&meridian, 0.5, 0.5 * (a.q + b.q), x, dx);
      const double angle = atan2(hypot(dx[0], dx[1]) * (b.q - a.q), x[0] * (a.theta - b.theta));
      const double from_mean = (angle - cw_blade_beta(&rounded, p)) / degree;
      assert_true(side == CW_BLADE_PRESSURE ? from_mean < -0.3 : from_mean > 0.3);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(thick_rounded_sides_do_not_swing),
      cmocka_unit_test(cylindrical_sections_lie_over_each_other),
      cmocka_unit_test(spiral),
      cmocka_unit_test(wrap_closes),
      cmocka_unit_test(thickness),
      cmocka_unit_test(nose),
      cmocka_unit_test(bevel),
      cmocka_unit_test(clearance),
  };
  return cmocka_run_group_tests(tests, setup, NULL);
}
