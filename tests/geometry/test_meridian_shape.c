// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "geometry/meridian_passage.h"
#include "geometry/meridian_shape.h"
#include "pipeline/case_schema.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

enum { COUNT = 201 };

static CwCase paper_case;
static CwDesign paper_design;

static int setup(void **state) {
  paper_case = paper();
  paper_design = design_of(&paper_case);
  return 0;
}

static double reversal_of(const CwDesign *design) {
  CwMeridianCurve hub, shroud;
  CwPassageStation station[COUNT];
  cw_meridian_walls(design, design->hub_pole_radial, design->shroud_pole_axial, design->shroud_pole_radial, &hub,
                    &shroud);
  cw_meridian_passage(&hub, &shroud, design->outlet_diameter / 2, COUNT, station);
  return cw_passage_reversal(station, COUNT);
}

// Integral of the squared curvature of both walls.
static double bending_of(const CwDesign *design, const double share[3]) {
  CwMeridianCurve wall[2];
  double sum = 0;
  cw_meridian_walls(design, share[0], share[1], share[2], &wall[0], &wall[1]);
  for (int w = 0; w < 2; w++)
    for (int i = 0; i < 1000; i++) {
      double x[2], dx[2];
      const double t = (i + 0.5) / 1000, k = cw_meridian_curvature(&wall[w], t);
      cw_meridian_point(&wall[w], t, x, dx);
      sum += k * k * hypot(dx[0], dx[1]) / 1000;
    }
  return sum;
}

// From low to high specific speed, of both families, the area grows all the way from the eye to D2, and the shroud
// bends gently.
static void area_is_monotone(void **state) {
  static const double duty[][2] = {{30, 20}, {40, 20},  {25, 10},
                                   {60, 12}, {200, 15}, {300, 13.5}}; // m3/h, m at 1450 rpm
  assert_true(reversal_of(&paper_design) == 0 && paper_design.passage_area_reversal == 0);
  for (int i = 0; i < 12; i++) {
    CwCase table = duty_point(duty[i / 2][0], duty[i / 2][1], 1450);
    table.design.correlations = i % 2 ? CW_CORRELATIONS_GUAN : CW_CORRELATIONS_GUELICH;
    const CwDesign design = design_of(&table);
    if (reversal_of(&design) > 0 || design.passage_area_outlet <= design.passage_area_eye)
      fail_msg("nq %.1f: from %.0f to %.0f mm2, %.4f back", design.specific_speed_nq, design.passage_area_eye * 1e6,
               design.passage_area_outlet * 1e6, reversal_of(&design));
    // Above nq 58 no walls of the axial length, which shrinks with D2 - D1, bend so gently.
    const double bend = design.shroud_bend_radius / design.inlet_passage_width;
    if (!(bend > (design.specific_speed_nq < 58 ? 0.6 : 0.55)))
      fail_msg("nq %.1f: the shroud bends with %.3f b1", design.specific_speed_nq, bend);
  }
}

// No other walls on a grid with a monotone area bend less.
static void bends_least(void **state) {
  CwDesign other = paper_design;
  const double found[3] = {other.hub_pole_radial, other.shroud_pole_axial, other.shroud_pole_radial};
  const double least = bending_of(&other, found);
  int monotone = 0;
  for (int i = 0; i < 12 * 12 * 12; i++) {
    const double share[3] = {1.2 + 0.14 * (i % 12), 0.02 + 0.08 * (i / 12 % 12), 0.07 * (i / 144)};
    other.hub_pole_radial = share[0];
    other.shroud_pole_axial = share[1];
    other.shroud_pole_radial = share[2];
    if (reversal_of(&other) > 0) continue;
    monotone++;
    if (bending_of(&other, share) < 0.99 * least)
      fail_msg("shares %.2f %.2f %.2f bend less: %.4g, found %.4g", share[0], share[1], share[2],
               bending_of(&other, share), least);
  }
  assert_true(monotone > 0);
}

// At high specific speed, where the eye is nearly as wide as D2, too, the hub does not reach beyond its end.
static void the_hub_goes_outwards(void **state) {
  for (int i = 0; i < 10; i++) {
    CwCase table;
    CwDesign design;
    CwMeridian meridian;
    cw_case_defaults(&table);
    const double nq = 6 * pow(15, i / 9.0), flow_rate = 0.6, head = 34;
    table.operating_point.flow_rate = flow_rate;
    table.operating_point.head = head;
    table.operating_point.speed = nq * pow(head, 0.75) / sqrt(flow_rate) * M_PI / 30;
    if (cw_hydraulic_design(&table, &design) != CW_OK || cw_meridian_make(&design, &meridian) != CW_OK)
      fail_msg("nq %.1f: %s", nq, cw_fail_message());
    for (int k = 0; k <= 100; k++) {
      double x[2], dx[2];
      cw_meridian_point(&meridian.hub, k / 100.0, x, dx);
      if (!(dx[0] >= -1e-12 && hypot(dx[0], dx[1]) > 0)) fail_msg("nq %.1f: the hub turns back at %.4f m", nq, x[0]);
    }
  }
}

static void size_does_not_matter(void **state) {
  CwDesign large = paper_design;
  double *length[] = {&large.inlet_diameter,
                      &large.outlet_diameter,
                      &large.outlet_width,
                      &large.hub_diameter,
                      &large.axial_length,
                      &large.interface_radius,
                      &large.leading_edge_radius_shroud};
  for (size_t i = 0; i < sizeof length / sizeof *length; i++) *length[i] *= 8;
  large.hub_pole_radial = NAN;
  cw_meridian_shape(&paper_case.impeller, &large);
  assert_true(large.hub_pole_radial == paper_design.hub_pole_radial);
  assert_true(large.shroud_pole_axial == paper_design.shroud_pole_axial);
  assert_true(large.shroud_pole_radial == paper_design.shroud_pole_radial);
}

static void given_poles_are_kept(void **state) {
  CwCase table = paper_case;
  table.impeller.hub_pole_radial = 1.471;
  table.impeller.shroud_pole_axial = 0.431;
  table.impeller.shroud_pole_radial = 0.022;
  CwDesign design = design_of(&table);
  assert_true(design.hub_pole_radial == 1.471 && design.shroud_pole_axial == 0.431 &&
              design.shroud_pole_radial == 0.022);
  assert_true(design.passage_area_reversal > 0.04);
  table.impeller.shroud_pole_axial = table.impeller.shroud_pole_radial = NAN;
  design = design_of(&table);
  assert_true(design.hub_pole_radial == 1.471);
  assert_true(design.passage_area_reversal < 0.03);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(area_is_monotone),      cmocka_unit_test(bends_least),
      cmocka_unit_test(the_hub_goes_outwards), cmocka_unit_test(size_does_not_matter),
      cmocka_unit_test(given_poles_are_kept),
  };
  return cmocka_run_group_tests(tests, setup, NULL);
}
