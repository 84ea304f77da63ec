// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/hydraulic_design.h"
#include "geometry/meridian_passage.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

enum { COUNT = 33 };

// A straight line from (r, z) to (r, z) as a cubic.
static CwMeridianCurve line(double r0, double z0, double r1, double z1) {
  CwMeridianCurve curve;
  for (int i = 0; i < 4; i++) {
    curve.pole[i][0] = r0 + (r1 - r0) * i / 3;
    curve.pole[i][1] = z0 + (z1 - z0) * i / 3;
  }
  return curve;
}

static void straight_annulus(void **state) {
  const CwMeridianCurve hub = line(1, 0, 1, 3), shroud = line(2, 0, 2, 3);
  CwPassageStation station[COUNT];
  cw_meridian_passage(&hub, &shroud, 3, COUNT, station);
  for (int i = 0; i < COUNT; i++) {
    assert_near(station[i].hub[1], station[i].shroud[1], 1e-12);
    assert_near(station[i].area, 3 * M_PI, 1e-12);
  }
  assert_near(station[COUNT - 1].length, 3, 1e-9);
}

// Between parallel disks 2 pi r b; the last station lies at the radius asked.
static void parallel_disks(void **state) {
  const CwMeridianCurve hub = line(1, 0.5, 4, 0.5), shroud = line(1, -0.5, 4, -0.5);
  CwPassageStation station[COUNT];
  cw_meridian_passage(&hub, &shroud, 3, COUNT, station);
  for (int i = 0; i < COUNT; i++) {
    assert_near(station[i].hub[0], station[i].shroud[0], 1e-12);
    assert_near(station[i].area, 2 * M_PI * station[i].shroud[0], 1e-11);
  }
  assert_near(station[COUNT - 1].shroud[0], 3, 1e-12);
}

// A wedge: lines across it make the same angle with both walls, so that both ends are as far from its tip.
static void wedge(void **state) {
  const CwMeridianCurve hub = line(1, 1, 1, 5), shroud = line(2, 1, 6, 5); // tip at r = 1, z = 0
  CwPassageStation station[COUNT];
  cw_meridian_passage(&hub, &shroud, 7, COUNT, station);
  for (int i = 0; i < COUNT && station[i].hub[1] < 5; i++)
    assert_near(hypot(station[i].shroud[0] - 1, station[i].shroud[1]), station[i].hub[1], 1e-10);
}

static void paper_passage(CwMeridian *meridian, CwPassageStation *station) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  assert_int_equal(cw_meridian_make(&design, meridian), CW_OK);
  cw_meridian_passage(&meridian->hub, &meridian->shroud, design.outlet_diameter / 2, COUNT, station);
}

// On the paper's wheel: both angles alike, and the area as an integral over the line.
static void papers_wheel(void **state) {
  CwMeridian meridian;
  CwPassageStation station[COUNT];
  paper_passage(&meridian, station);
  for (int i = 0; i < COUNT; i++) {
    const CwPassageStation *s = &station[i];
    const double across[2] = {s->shroud[0] - s->hub[0], s->shroud[1] - s->hub[1]}, width = hypot(across[0], across[1]);
    double cosine[2], sum = 0;
    for (int wall = 0; wall < 2; wall++) {
      const CwMeridianCurve *curve = wall ? &meridian.shroud : &meridian.hub;
      const double *end = wall ? s->shroud : s->hub;
      double x[2], dx[2] = {0}, least = HUGE_VAL;
      for (int k = -4000; k <= 20000; k++) { // the curve's direction at its point nearest to the end
        double d[2];
        cw_meridian_point(curve, k / 20000.0, x, d);
        const double distance = hypot(x[0] - end[0], x[1] - end[1]);
        if (distance < least) {
          least = distance;
          dx[0] = d[0];
          dx[1] = d[1];
        }
      }
      assert_true(least < 1e-5);
      cosine[wall] = (dx[0] * across[0] + dx[1] * across[1]) / (hypot(dx[0], dx[1]) * width);
    }
    assert_near(cosine[0], -cosine[1], 2e-3);
    for (int k = 0; k < 100; k++) sum += 2 * M_PI * (s->hub[0] + across[0] * (k + 0.5) / 100) * width / 100;
    assert_near(s->area, sum, 1e-12);
  }
}

// The line at a radius of the shroud is that of the stations about it.
static void line_at_a_radius(void **state) {
  CwMeridian meridian;
  CwPassageStation station[COUNT];
  paper_passage(&meridian, station);
  for (int i = 1; i < COUNT; i++) {
    const CwPassageStation at = cw_meridian_passage_at(&meridian.hub, &meridian.shroud, station[i].shroud[0]);
    assert_near(at.hub[0], station[i].hub[0], 1e-9);
    assert_near(at.height, station[i].height, 1e-9);
    assert_near(at.area, station[i].area, 1e-10);
  }
}

static void reversal(void **state) {
  CwPassageStation station[5] = {{.area = 10}, {.area = 12}, {.area = 11.4}, {.area = 12.6}, {.area = 13}};
  assert_near(cw_passage_reversal(station, 5), 0.05, 1e-12);
  station[2].area = 12.3;
  assert_true(cw_passage_reversal(station, 5) == 0);
  station[4].area = 8; // should fall then, but rises from 10 to 12.6
  assert_near(cw_passage_reversal(station, 5), 0.26, 1e-12);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(straight_annulus), cmocka_unit_test(parallel_disks),   cmocka_unit_test(wedge),
      cmocka_unit_test(papers_wheel),     cmocka_unit_test(line_at_a_radius), cmocka_unit_test(reversal),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
