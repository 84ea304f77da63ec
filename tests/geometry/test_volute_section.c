// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/volute_section.h"

#include <math.h>
#include <string.h>

#include "tests/draw.h"
#include "tests/geometry/paper_volute.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180, mm = 1e-3;

// Worked by hand for K = 0.758 m2/s and 15 degrees: (b3 - 2 r3 tan a) ln(ro/r3) + 2 tan a (ro - r3) = Q phi /
// 2 pi K.
static void trapezoid_heights(void **state) {
  const double expected[] = {8.5, 15.6, 21.9, 27.6, 33.0, 38.1, 42.9, 47.5};
  for (int i = 0; i < 8; i++) {
    double share = 25 / 3600.0 / 0.758 * (i + 1) / 8;
    assert_near(cw_volute_trapezoid_height(102 * mm, 12 * mm, 15 * degree, share), expected[i] * mm, 0.1 * mm);
  }
  // Parallel walls: b3 ln(ro/r3) = q.
  assert_near(cw_volute_trapezoid_height(0.1, 0.02, 0, 0.02 * log(1.3)), 0.03, 1e-14);
}

// Area and integral of b dr / r by summing strips of the section.
static void section_by_strips(void **state) {
  CwVoluteInput input = volute_of_paper();
  CwVolute volute = designed_volute(&input);
  for (double phi = 0; phi < 6.5; phi += 0.8) {
    CwVoluteSection s = cw_volute_section(&volute, phi);
    enum { STRIPS = 200000 };
    double area = 0, integral = 0, step = (s.outer_radius - 0.102) / STRIPS;
    for (int i = 0; i < STRIPS; i++) {
      double r = 0.102 + (i + 0.5) * step, width = 0.012 + 2 * (r - 0.102) * tan(20 * degree);
      if (r > s.kink_radius) width = 2 * sqrt(fmax(0, pow(s.arc_radius, 2) - pow(r - s.arc_centre, 2)));
      area += width * step;
      integral += width * step / r;
    }
    assert_near(area, s.area, 1e-5 * s.area);
    assert_near(integral, s.integral, 1e-5 * s.integral);
    // The law: the same share of the flow for each angle.
    assert_near(s.integral, volute.law_start + (volute.law_end - volute.law_start) * phi / (2 * M_PI), 1e-15);
    double ahead = cw_volute_section(&volute, phi + 1e-5).kink_radius;
    double behind = cw_volute_section(&volute, phi - 1e-5).kink_radius;
    assert_near(s.kink_slope, (ahead - behind) / 2e-5, 1e-7);
  }
}

// Trapezoid with corners, rectangle and circle, by both laws.
static CwVoluteInput family(int kind) {
  CwVoluteInput input = volute_of_paper();
  input.throat_area = NAN;
  input.section = kind == 0 ? CW_SECTION_TRAPEZOID : kind == 1 ? CW_SECTION_RECTANGLE : CW_SECTION_CIRCLE;
  input.area_law = kind == 2 ? CW_AREA_LAW_ANGULAR_MOMENTUM : CW_AREA_LAW_VELOCITY;
  input.inlet_width = (kind == 1 ? 28 : 14) * mm;
  input.corner_radius = kind == 2 ? NAN : 4 * mm;
  return input;
}

// The sections' area and integral around the outline of cw_volute_wall_point, by Green's theorem, and their
// law; where the arcs no longer grow they touch the side walls and have the given radius.
static void families_of_sections(void **state) {
  for (int kind = 0; kind < 3; kind++) {
    CwVoluteInput input = family(kind);
    CwVolute volute = designed_volute(&input);
    double a = kind == 1 ? 0 : 20 * degree, k0 = volute.arc_half_angle, b3 = input.inlet_width;
    assert_near(volute.end_half_angle, 90 * degree + a, 1e-14);
    for (double phi = volute.start_angle; phi < 6.9; phi += 0.7) {
      CwVoluteSection s = cw_volute_section(&volute, phi);
      enum { PIECES = 40000 };
      double area = 0, integral = 0, before[3], x[3], r = s.kink_radius, slope = tan(a);
      cw_volute_wall_point(&volute, phi, -k0, before, NULL, NULL);
      assert_near(hypot(before[0], before[1]), r, 1e-12);
      assert_near(before[2], -(b3 / 2 + (r - 0.102) * slope), 1e-12);
      for (int i = 1; i <= PIECES; i++) {
        cw_volute_wall_point(&volute, phi, k0 * (2.0 * i / PIECES - 1), x, NULL, NULL);
        double r0 = hypot(before[0], before[1]), r1 = hypot(x[0], x[1]), dz = x[2] - before[2];
        area += 0.5 * (r0 + r1) * dz;
        integral += 0.5 * (log(r0) + log(r1)) * dz;
        for (int j = 0; j < 3; j++) before[j] = x[j];
      }
      // The rest of the way round, clockwise: along the side walls inward and across the base circle.
      double h = s.kink_height;
      area -= 0.102 * b3 + 2 * (h - b3 / 2) * (r + 0.102) / 2;
      integral -= log(0.102) * b3;
      for (int i = 0; i < 2000; i++) integral -= 2 * log(0.102 + (r - 0.102) * (i + 0.5) / 2000) * (h - b3 / 2) / 2000;
      assert_near(s.area, area, 1e-6 * s.area);
      assert_near(s.integral, integral, 1e-6 * s.integral);
      double law = input.area_law == CW_AREA_LAW_VELOCITY ? s.area : s.integral;
      assert_near(law, volute.law_start + (volute.law_end - volute.law_start) * phi / (2 * M_PI), 1e-14);
      if (phi > volute.start_angle + 2 * CW_VOLUTE_SECTOR) {
        double p[3], along[3];
        cw_volute_wall_point(&volute, phi, k0, p, NULL, along);
        assert_near(along[2] / hypot(along[0], along[1]), slope * cos(atan2(along[1], along[0]) - phi),
                    1e-9); // on along the side wall
        if (kind < 2) assert_near(s.arc_radius, 4 * mm, 1e-15);
      }
    }
    if (kind < 2) assert_near((volute.law_end - volute.law_start) * input.section_speed, input.flow_rate, 1e-12);
    // The nose touches the outer wall from outside.
    double outer = cw_volute_section(&volute, volute.tip_angle).outer_radius;
    assert_true(volute.tip_radius <= outer && volute.tip_radius > outer - 1 * mm);
  }
}

static void wall_derivatives(void **state) {
  for (int kind = 0; kind < 4; kind++) {
    CwVoluteInput input = kind < 3 ? family(kind) : volute_of_paper();
    CwVolute volute = designed_volute(&input);
    double x[3], a[3], b[3], ahead[3], behind[3], h = 1e-6;
    for (double phi = 0.9; phi < 4; phi += 0.6)
      for (double psi = -0.59; psi < 0.6; psi += 0.29) {
        cw_volute_wall_point(&volute, phi, psi, x, a, b);
        cw_volute_wall_point(&volute, phi + h, psi, ahead, NULL, NULL);
        cw_volute_wall_point(&volute, phi - h, psi, behind, NULL, NULL);
        for (int i = 0; i < 3; i++) assert_near(a[i], (ahead[i] - behind[i]) / (2 * h), 2e-7);
        cw_volute_wall_point(&volute, phi, psi + h, ahead, NULL, NULL);
        cw_volute_wall_point(&volute, phi, psi - h, behind, NULL, NULL);
        for (int i = 0; i < 3; i++) assert_near(b[i], (ahead[i] - behind[i]) / (2 * h), 2e-7);
      }
  }
}

// Wide side walls and a large section: the arc's radius is more than its centre's distance from the axis.
static void arc_beyond_axis(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.side_wall_angle = 30 * degree;
  CwVolute volute = designed_volute(&input);
  CwVoluteSection s = cw_volute_section(&volute, 100);
  assert_true(s.arc_radius > s.arc_centre);
  double k = volute.arc_half_angle, sum = 0;
  for (int i = 0; i < 20000; i++) {
    double psi = k * (i + 0.5) / 20000, half = s.arc_radius * sin(psi);
    sum += 2 * half * half / (s.arc_centre + s.arc_radius * cos(psi)) * k / 20000;
  }
  double r = s.kink_radius, slope = tan(30 * degree);
  assert_near(s.integral, (0.012 - 0.204 * slope) * log(r / 0.102) + 2 * slope * (r - 0.102) + sum, 1e-9);
}

// The contour's parameter at a level leads back to that level, on the wall's radius there; the part below the middle is
// the mirror image of the one above.
static void levels_are_found_on_the_contour(void **state) {
  uint64_t seed = 41;
  for (int kind = 0; kind < 4; kind++) {
    CwVoluteInput input = kind < 3 ? family(kind) : volute_of_paper();
    const CwVolute volute = designed_volute(&input);
    for (int i = 0; i < 300; i++) {
      const double phi = volute.start_angle + 6 * draw(&seed);
      const CwVoluteSection s = cw_volute_section(&volute, phi);
      // Of an arc that goes on inwards from its middle only the outer part is asked for.
      const double most = fmin(s.kink_height, s.flat + s.arc_radius), w = most * draw(&seed);
      const double psi = cw_volute_section_parameter(&volute, &s, w);
      double above[3], below[3];
      cw_volute_wall_point(&volute, phi, psi, above, NULL, NULL);
      cw_volute_wall_point(&volute, phi, -psi, below, NULL, NULL);
      assert_true(psi >= 0);
      assert_near(above[2], w, 1e-12);
      assert_near(atan2(above[1], above[0]), remainder(phi, 2 * M_PI), 1e-12);
      assert_near(hypot(above[0], above[1]), cw_volute_wall_radius(&s, w), 1e-9);
      assert_near(cw_volute_wall_radius(&s, -w), cw_volute_wall_radius(&s, w), 0);
      assert_near(below[2], -w, 1e-12);
      for (int k = 0; k < 2; k++) assert_near(below[k], above[k], 1e-15);
    }
    // At the base circle the side walls are b3 apart, and further out by twice the tangent of their angle.
    const double a = kind == 1 ? 0 : 20 * degree;
    assert_near(cw_volute_half_width(&volute, 0.102), input.inlet_width / 2, 1e-15);
    assert_near(cw_volute_half_width(&volute, 0.132), input.inlet_width / 2 + 0.03 * tan(a), 1e-15);
    assert_int_equal(cw_volute_has_corners(&volute), kind < 2);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(trapezoid_heights),    cmocka_unit_test(section_by_strips),
      cmocka_unit_test(families_of_sections), cmocka_unit_test(wall_derivatives),
      cmocka_unit_test(arc_beyond_axis),      cmocka_unit_test(levels_are_found_on_the_contour),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
