// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "pipeline/case.h"

static CwDesign design;
static CwMeridian meridian;

static int setup(void **state) {
  CwCase table;
  return cw_case_read(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", &table) ||
         cw_hydraulic_design(&table, &design) || cw_meridian_make(&design, &meridian);
}

static void near_to(double value, double expected, double tolerance) {
  if (!(fabs(value - expected) <= tolerance))
    fail_msg("%.10g is not %.10g within %.3g", value, expected, tolerance);
}

// Against the sum of a million chords.
static void arc_length(void **state) {
  const CwMeridianCurve *curve = &meridian.shroud;
  double sum = 0, last[2], x[2];
  cw_meridian_point(curve, 0, last, NULL);
  for (int i = 1; i <= 1000000; i++) {
    cw_meridian_point(curve, i * 1e-6, x, NULL);
    sum += hypot(x[0] - last[0], x[1] - last[1]);
    last[0] = x[0];
    last[1] = x[1];
  }
  near_to(cw_meridian_length(curve, 1), sum, 1e-11);
  for (double t = 0.013; t < 1; t += 0.05)
    near_to(cw_meridian_parameter(curve, cw_meridian_length(curve, t)), t, 1e-12);
}

static void ends_of_the_blade(void **state) {
  double x[2];
  for (int s = 0; s <= 1; s++) {
    cw_meridian_blade_point(&meridian, s, 0, x, NULL);
    near_to(x[0], s ? design.leading_edge_radius_shroud : design.leading_edge_radius_hub, 1e-12);
  }
  for (double s = 0; s <= 1; s += 0.25) {
    cw_meridian_blade_point(&meridian, s, 1, x, NULL);
    near_to(x[0], 0.100, 1e-12);
  }
}

// The passage grows from the eye to the outlet, where it is pi D2 b2, and the shroud bends gently: on the paper's
// wheel and on others from low to high specific speed.
static void areas(void **state) {
  static const double duty[][2] = {{25, 10}, {12, 20}, {60, 12}, {200, 15}, {300, 10}}; // m3/h, m at 1450 rpm
  near_to(cw_meridian_area(&meridian, 1), M_PI * 0.2 * 0.008, 1e-6); // the hub is not quite flat at D2
  for (size_t i = 0; i < sizeof duty / sizeof *duty; i++) {
    CwCase table;
    CwDesign made = design;
    CwMeridian section;
    cw_case_defaults(&table);
    table.operating_point.flow_rate = duty[i][0] / 3600;
    table.operating_point.head = duty[i][1];
    table.operating_point.speed = 1450 * M_PI / 30;
    if (i > 0)
      assert_int_equal(cw_hydraulic_design(&table, &made), CW_OK);
    assert_int_equal(cw_meridian_make(&made, &section), CW_OK);
    double largest = M_PI / 4 * (pow(made.inlet_diameter, 2) - pow(made.hub_diameter, 2));
    for (double q = 0; q <= 1; q += 0.02) {
      const double area = cw_meridian_area(&section, q);
      if (area < 0.97 * largest)
        fail_msg("nq %.1f: the passage falls to %.0f mm2 at q = %.2f after %.0f mm2", made.specific_speed_nq,
                 area * 1e6, q, largest * 1e6);
      largest = fmax(largest, area);
    }
    assert_true(made.passage_area_fall < 0.03);
    assert_true(cw_meridian_bend_radius(&section.shroud) > 0.5 * made.inlet_passage_width);
  }
  assert_true(design.passage_area_fall < 0.01);
}

// Volume of revolution against the sum over thin slices of r: 2 pi r times the height.
static void volume(void **state) {
  enum { SLICES = 200000 };
  double sum = 0;
  const double ri = design.interface_radius;
  for (int i = 0; i < SLICES; i++) {
    const double r = (i + 0.5) * ri / SLICES;
    double low, high, x[2];
    const CwMeridianCurve *curve[2] = {&meridian.hub, &meridian.shroud};
    double z[2] = {meridian.nut_end_z, meridian.inlet_z};
    for (int w = 0; w < 2; w++) {
      if (r <= curve[w]->pole[0][0])
        continue;
      double a = 0, b = 1;
      for (int k = 0; k < 40; k++) {
        cw_meridian_point(curve[w], 0.5 * (a + b), x, NULL);
        *(x[0] < r ? &a : &b) = 0.5 * (a + b);
      }
      cw_meridian_point(curve[w], a, x, NULL);
      z[w] = x[1];
    }
    const double rd = meridian.nut_disk_radius, rn = meridian.hub.pole[0][0];
    if (r > rd && r < rn) {
      const double f = (r - rd) / (rn - rd);
      z[0] = meridian.hub.pole[0][1] - design.nut_length * sqrt(1 - f * f);
    }
    high = z[0];
    low = z[1];
    sum += 2 * M_PI * r * (high - low) * ri / SLICES;
  }
  near_to(cw_meridian_volume(&meridian) / sum, 1, 4e-6);
}

static void misplaced_leading_edge_is_refused(void **state) {
  CwDesign wrong = design;
  CwMeridian made;
  wrong.leading_edge_radius_shroud = 0.030;
  assert_int_equal(cw_meridian_make(&wrong, &made), CW_ERR_DESIGN);
  cw_fail_clear();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arc_length),
      cmocka_unit_test(ends_of_the_blade),
      cmocka_unit_test(areas),
      cmocka_unit_test(volume),
      cmocka_unit_test(misplaced_leading_edge_is_refused),
  };
  return cmocka_run_group_tests(tests, setup, NULL);
}
