// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static CwDesign design;
static CwMeridian meridian;

static int setup(void **state) {
  const CwCase table = paper();
  design = design_of(&table);
  return cw_meridian_make(&design, &meridian);
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
  assert_near(cw_meridian_length(curve, 1), sum, 1e-11);
  for (double t = 0.013; t < 1; t += 0.05)
    assert_near(cw_meridian_parameter(curve, cw_meridian_length(curve, t)), t, 1e-12);
}

static void ends_of_the_blade(void **state) {
  double x[2];
  for (int s = 0; s <= 1; s++) {
    cw_meridian_blade_point(&meridian, s, 0, x, NULL);
    assert_near(x[0], s ? design.leading_edge_radius_shroud : design.leading_edge_radius_hub, 1e-12);
  }
  for (double s = 0; s <= 1; s += 0.25) {
    cw_meridian_blade_point(&meridian, s, 1, x, NULL);
    assert_near(x[0], 0.100, 1e-12);
  }
}

// The area at the blade's ends: pi D2 b2 at D2, where both walls are radial, and square to the flow at the leading
// edge.
static void areas(void **state) {
  assert_near(cw_meridian_area(&meridian, 1), M_PI * 0.2 * 0.008, 4e-6); // the hub is not quite flat at D2
  double h[2], c[2], a[2], b[2];
  cw_meridian_blade_point(&meridian, 0, 0, h, NULL);
  cw_meridian_blade_point(&meridian, 1, 0, c, NULL);
  cw_meridian_blade_point(&meridian, 0.5, 0, a, NULL);
  cw_meridian_blade_point(&meridian, 0.5, 1e-6, b, NULL);
  const double along =
      ((c[0] - h[0]) * (b[0] - a[0]) + (c[1] - h[1]) * (b[1] - a[1])) / hypot(b[0] - a[0], b[1] - a[1]);
  const double width = sqrt(pow(c[0] - h[0], 2) + pow(c[1] - h[1], 2) - along * along);
  assert_near(cw_meridian_area(&meridian, 0), M_PI * (h[0] + c[0]) * width, 1e-9);
}

// Of a quarter circle's usual cubic.
static void curvature(void **state) {
  const double k = 0.5522847498;
  const CwMeridianCurve quarter = {.pole = {{0, 3}, {3 * k, 3}, {3, 3 * k}, {3, 0}}};
  for (double t = 0; t <= 1; t += 0.1) assert_near(cw_meridian_curvature(&quarter, t), 1.0 / 3, 0.01);
  assert_near(cw_meridian_bend_radius(&quarter), 3, 0.08);
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
      if (r <= curve[w]->pole[0][0]) continue;
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
  assert_near(cw_meridian_volume(&meridian) / sum, 1, 4e-6);
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
      cmocka_unit_test(arc_length), cmocka_unit_test(ends_of_the_blade),
      cmocka_unit_test(areas),      cmocka_unit_test(curvature),
      cmocka_unit_test(volume),     cmocka_unit_test(misplaced_leading_edge_is_refused),
  };
  return cmocka_run_group_tests(tests, setup, NULL);
}
