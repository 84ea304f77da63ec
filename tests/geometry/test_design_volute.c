// SPDX-License-Identifier: AGPL-3.0-or-later
// Volutes of pumps given by their duty alone, from nq 6 to 90 and from D2 of 20 mm to 4 m.
#include <math.h>
#include <string.h>

#include "geometry/design_volute.h"
#include "geometry/hydraulic_design.h"
#include "geometry/volute_design.h"
#include "pipeline/case_schema.h"
#include "tests/geometry/paper_volute.h"
#include "tests/unit_test.h"

static const double LEAST_FLOW = 0.3 / 3600; // m3/s

// A pump of the size D2 (m, about) that turns with u2 = 25 m/s: psi by Guelich gives the head, nq the flow rate.
static CwCase case_with(double nq, double size, const CwVoluteTable *volute) {
  CwCase table;
  const double speed = 25 / (size / 2), rpm = speed * 30 / M_PI;
  const double head = 1.21 * exp(-0.77 * nq / 100) * 25 * 25 / (2 * 9.80665);
  cw_case_defaults(&table);
  if (volute) table.volute = *volute;
  table.operating_point.head = head;
  table.operating_point.speed = speed;
  table.operating_point.flow_rate = pow(nq * pow(head, 0.75) / rpm, 2);
  return table;
}

// Returns 0 where the flow rate is under 0.3 m3/h.
static int duty_with(double nq, double size, const CwVoluteTable *volute, CwDesign *design) {
  const CwCase table = case_with(nq, size, volute);
  if (table.operating_point.flow_rate < LEAST_FLOW) return 0;
  if (cw_hydraulic_design(&table, design) != CW_OK) fail_msg("nq %g, D2 %g m: %s", nq, size, cw_fail_message());
  return 1;
}

static int duty(double nq, double size, CwDesign *design) {
  return duty_with(nq, size, NULL, design);
}

// A spiral that would be too tall: what is open of b3 and side walls yields, then given side walls or a rectangle,
// which becomes a trapezoid, then a given b3. What yields without having been given was not asked; what stays is as
// given.
static void given_walls_yield_after_open_ones(void **state) {
  static const struct {
    double nq;
    int angle_given, width_given;
    CwVoluteSectionKind section;
    int angle_yields, width_yields;
  } cases[] = {{65, 0, 0, CW_SECTION_TRAPEZOID, 0, 0}, {65, 0, 0, CW_SECTION_CIRCLE, 0, 0},
               {60, 1, 0, CW_SECTION_TRAPEZOID, 0, 0}, {75, 1, 0, CW_SECTION_TRAPEZOID, 1, 0},
               {45, 0, 0, CW_SECTION_RECTANGLE, 0, 0}, {75, 0, 0, CW_SECTION_RECTANGLE, 1, 0},
               {90, 0, 1, CW_SECTION_TRAPEZOID, 0, 1}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    CwCase table;
    CwDesign d;
    CwVoluteTable *given = &table.volute;
    cw_case_defaults(&table);
    given->section = cases[i].section;
    if (cases[i].angle_given) given->side_wall_angle = 10 * M_PI / 180;
    if (cases[i].width_given) given->inlet_width = 0.06; // 1.05 b2
    assert_true(duty_with(cases[i].nq, 0.3, given, &d));
    const int rectangle = given->section == CW_SECTION_RECTANGLE;
    const double angle = rectangle ? 0 : given->side_wall_angle, asked_angle = d.asked[CW_DESIGN_side_wall_angle];
    assert_int_equal(!isnan(asked_angle), cases[i].angle_yields);
    assert_int_equal(!isnan(d.asked[CW_DESIGN_inlet_width]), cases[i].width_yields);
    if (cases[i].angle_yields) assert_near(asked_angle, angle, 1e-15);
    if (cases[i].width_yields) assert_near(d.asked[CW_DESIGN_inlet_width], given->inlet_width, 1e-15);
    if (cases[i].angle_given || rectangle) assert_int_equal(d.side_wall_angle > angle + 1e-9, cases[i].angle_yields);
    if (cases[i].width_yields) assert_true(d.side_wall_angle > 20.5 * M_PI / 180); // from 20 degrees on, as an open one
    if (given->section == CW_SECTION_TRAPEZOID || !cases[i].angle_yields)
      assert_int_equal(d.volute.input.section, given->section);
  }
}

// Side walls of 3 degrees and a b3 of b2 give way to the least of 5 degrees and b2 + 0.005 D3, and to no more. The
// tongue's tip comes from what is given.
static void least_walls_replace_less(void **state) {
  CwCase table;
  CwDesign d, wide;
  cw_case_defaults(&table);
  table.volute.side_wall_angle = 3 * M_PI / 180;
  table.volute.tongue_angle = 33 * M_PI / 180;
  assert_true(duty_with(21, 0.2, &table.volute, &d));
  assert_near(d.side_wall_angle, 5 * M_PI / 180, 1e-12);
  assert_near(d.asked[CW_DESIGN_side_wall_angle], table.volute.side_wall_angle, 1e-15);
  assert_string_equal(d.source[CW_DESIGN_side_wall_angle], "side_wall_angle_deg gives way to the least of 5 deg");
  assert_string_equal(d.source[CW_DESIGN_tongue_tip_radius], "where its angle leads to");
  assert_true(duty(21, 0.2, &wide));
  assert_non_null(strstr(wide.source[CW_DESIGN_tongue_tip_radius], "0.07 rho H/(1000 kg/m3 1000 m)) to 1.2 r2"));
  cw_case_defaults(&table);
  table.volute.inlet_width = wide.outlet_width;
  assert_true(duty_with(21, 0.2, &table.volute, &d));
  assert_near(d.inlet_width, wide.outlet_width + 0.005 * wide.base_diameter, 1e-12);
  assert_near(d.asked[CW_DESIGN_inlet_width], wide.outlet_width, 1e-15);
  assert_near(d.side_wall_angle, 20 * M_PI / 180, 1e-12);
  assert_true(isnan(d.asked[CW_DESIGN_side_wall_angle]));
}

// A bore under the throat's diameter and a diffuser that opens too fast are refused as they are. A wider spiral has a
// smaller throat nearer to the axis, which would fit the bore.
static void only_tall_spirals_are_widened(void **state) {
  CwCase table;
  CwDesign d, refused;
  assert_true(duty(21, 0.2, &d));
  cw_case_defaults(&table);
  table.volute.outlet_diameter = 0.99 * sqrt(d.throat_area * 4 / M_PI);
  CwCase narrow = case_with(21, 0.2, &table.volute);
  assert_int_equal(cw_hydraulic_design(&narrow, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "outlet_diameter_mm"));
  assert_near(refused.inlet_width, d.inlet_width, 1e-12);
  assert_near(refused.tongue_radius, d.tongue_radius, 1e-12);
  table.volute.outlet_diameter = NAN;
  table.volute.diffuser_length = 0.9 * d.diffuser_length * tan(0.5 * d.diffuser_angle) / tan(15 * M_PI / 180);
  CwCase steep = case_with(21, 0.2, &table.volute);
  assert_int_equal(cw_hydraulic_design(&steep, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "diffuser_length_mm"));
  assert_near(refused.inlet_width, d.inlet_width, 1e-12);
  cw_fail_clear();
}

// Of a wheel of 300 mm at nq 20 with b3 120 mm the throat is 27 mm high and 3.6 times as wide. Narrowed it is higher,
// but has 2516 instead of 2568 mm2, since the tongue lies nearer to the axis. A diffuser of given length that opens to
// 80 mm by 30 degrees from a throat between both ends the steps before that.
static void narrowing_ends_where_there_is_no_volute(void **state) {
  CwCase table;
  CwDesign usual;
  assert_true(duty(20, 0.3, &usual));
  usual.outlet_width = 0.06;
  usual.inlet_width = 0.12;
  cw_case_defaults(&table);
  table.volute.outlet_diameter = 0.08;
  CwDesign open = usual, wide = usual, short_one = usual;
  assert_int_equal(cw_design_volute(&table.volute, &open), CW_OK);
  assert_true(open.inlet_width < 0.099);
  table.volute.inlet_width = usual.inlet_width;
  table.volute.side_wall_angle = 20 * M_PI / 180;
  assert_int_equal(cw_design_volute(&table.volute, &wide), CW_OK);
  assert_true(open.throat_area < 0.99 * wide.throat_area);
  table.volute.inlet_width = table.volute.side_wall_angle = NAN;
  table.volute.diffuser_length =
      (0.04 - sqrt(0.5 * (open.throat_area + wide.throat_area) / M_PI)) / tan(15 * M_PI / 180);
  assert_int_equal(cw_design_volute(&table.volute, &short_one), CW_OK);
  assert_true(short_one.inlet_width > open.inlet_width);
  assert_near(short_one.diffuser_length, table.volute.diffuser_length, 1e-12);
}

static CwVoluteHelp help_of(const CwVoluteInput *input) {
  CwVolute volute;
  assert_int_equal(cw_volute_design(input, &volute), CW_ERR_DESIGN);
  cw_fail_clear();
  return volute.help;
}

// Q / K = 69.4 mm is more than a spiral within 2.5 D3/2 takes up, some 60 mm; no throat is wide enough beside a tongue
// of 15 mm; neither walls nor tongue help a diffuser of 20 mm or a b3 under b2 + 0.005 D3.
static void what_could_help(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.throat_area = NAN;
  input.angular_momentum = 0.1;
  assert_int_equal(help_of(&input), CW_VOLUTE_WIDER_SPIRAL);
  input = volute_of_paper();
  input.throat_area = 0.02;
  assert_int_equal(help_of(&input), CW_VOLUTE_WIDER_SPIRAL);
  input = volute_of_paper();
  input.tongue_radius = 0.015;
  assert_int_not_equal(help_of(&input), CW_VOLUTE_OTHER_INPUT);
  input = volute_of_paper();
  input.diffuser_length = 0.02;
  assert_int_equal(help_of(&input), CW_VOLUTE_OTHER_INPUT);
  input = volute_of_paper();
  input.inlet_width = 0.0085;
  assert_int_equal(help_of(&input), CW_VOLUTE_OTHER_INPUT);
}

static void volutes_of_any_duty(void **state) {
  static const double sizes[] = {0.02, 0.3, 4};
  int designed = 0;
  for (double nq = 6; nq < 91; nq *= 1.57)
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
      CwDesign d;
      if (!duty(nq, sizes[i], &d)) continue;
      designed++;
      const double tip = 2 * d.tongue_tip_radius / d.outlet_diameter;
      assert_true(tip > 1.045 && tip < 1.25);
      assert_true(d.diffuser_area_ratio > 1.499 && d.diffuser_area_ratio < 3.001);
      assert_true(d.diffuser_angle * 180 / M_PI < 9.001);
      assert_true(d.throat_area / pow(d.volute.throat_width, 2) < 3.1);
      // No faster than the swirl of the law at the radius of the tongue's tip, by 2 %.
      assert_true(d.throat_speed < 1.03 * d.swirl_constant / d.tongue_tip_radius);
      assert_true(d.hub_diameter < 0.36 * d.outlet_diameter);
    }
  assert_int_equal(designed, 18); // of 21: the smallest of nq 6, 9.4 and 14.8 pump less than 0.3 m3/h
}

// Of similar pumps (the same u2, twice the size) what does not depend on efficiencies has the same shares of D2.
static void similar_pumps(void **state) {
  CwDesign small, large;
  assert_true(duty(30, 0.3, &small) && duty(30, 0.6, &large));
  assert_near(large.base_diameter / large.outlet_diameter, small.base_diameter / small.outlet_diameter, 1e-12);
  assert_near(large.inlet_width / large.outlet_diameter, small.inlet_width / small.outlet_diameter, 1e-3);
  assert_near(large.tongue_radius / large.outlet_diameter, small.tongue_radius / small.outlet_diameter, 1e-12);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(given_walls_yield_after_open_ones),
      cmocka_unit_test(least_walls_replace_less),
      cmocka_unit_test(only_tall_spirals_are_widened),
      cmocka_unit_test(narrowing_ends_where_there_is_no_volute),
      cmocka_unit_test(what_could_help),
      cmocka_unit_test(volutes_of_any_duty),
      cmocka_unit_test(similar_pumps),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
