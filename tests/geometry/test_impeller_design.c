// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "geometry/blade.h"
#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;

// A given D3 bounds an open D2: 1.02 D2 at most, and more outlet angle makes up for the head, which is met all the
// same.
static void open_outlet_diameter_stays_within_the_volute(void **state) {
  CwCase table = duty_point(54, 20, 1800);
  const double open = design_of(&table).outlet_diameter;
  table.volute.base_diameter = 1.1 * open;
  assert_near(design_of(&table).outlet_diameter, open, 1e-9);
  table.volute.base_diameter = 1.01 * open;
  const CwDesign design = design_of(&table);
  assert_near(design.outlet_diameter, table.volute.base_diameter / 1.02, 1e-9);
  assert_near(design.predicted_head, 20, 1e-4);
  assert_true(design.outlet_blade_angle > 18 * degree);
  table.volute.base_diameter = 0.6 * open;
  const CwDesign wider = design_of(&table);
  assert_near(wider.asked[CW_DESIGN_base_diameter], 0.6 * open, 1e-12);
  assert_near(wider.outlet_diameter, open, 1e-9);
}

// Given dimensions go before the head down to a third of it, with the blade angle nearest to it; not where the head
// is the priority. With six blades and phi = 0.104 the head still grows up to 60 degrees: over u2^2/g it is
// 0.98 (1 - 0.931/3.505) - 0.061 = 0.658 there and 0.646 at 50 degrees; with the leading edge at 0.54 of D2 k_w takes
// 0.027 and 0.018 of that.
static void head_gives_way_to_given_dimensions(void **state) {
  CwCase table = duty_point(54, 20, 1800);
  const CwDesign open = design_of(&table);
  table.impeller.outlet_width = open.outlet_width;
  table.impeller.outlet_diameter = 0.85 * open.outlet_diameter;
  const CwDesign low = design_of(&table);
  assert_near(low.outlet_diameter, table.impeller.outlet_diameter, 1e-12);
  assert_near(low.outlet_blade_angle, 60 * degree, 1e-9);
  assert_true(low.predicted_head > 20.0 / 3 && low.predicted_head < 19.9);
  CwDesign refused;
  table.impeller.priority = CW_PRIORITY_HEAD;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  cw_fail_clear();
  table.impeller.priority = CW_PRIORITY_AUTO;
  table.impeller.outlet_diameter = 0.5 * open.outlet_diameter;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "change outlet_diameter_mm"));
  cw_fail_clear();
}

// Two blades, of which the head falls again over some 26 degrees. The paper's wheel with phi = 0.091, the leading edge
// at 0.43 of D2, tau2 = 1.017 and eta_h = 0.852 by Guelich: 18 deg gives 7.08 m, 22 deg 7.40 m, 26 deg 7.48 m, 36 deg
// 7.30 m, 60 deg 6.74 m. So 7.4 m are met at 22 and at 32 deg, of which the lesser is taken. With D2 open 18 deg is the
// limit of the usual angles with more head than 32 deg.
static void two_blades_meet_the_head(void **state) {
  CwCase table = paper();
  table.operating_point.head = 7.4;
  table.impeller.priority = CW_PRIORITY_HEAD;
  table.impeller.blade_count = 2;
  table.impeller.leading_edge_radius_hub = 0.039;
  table.impeller.leading_edge_radius_shroud = 0.047;
  const CwDesign given = design_of(&table);
  assert_near(given.predicted_head, 7.4, 1e-6);
  assert_near(given.outlet_blade_angle, 22 * degree, 0.6 * degree);
  assert_string_equal(given.source[CW_DESIGN_outlet_blade_angle], "solved for the head");

  table = duty_point(25, 10, 1450);
  table.impeller.blade_count = 2;
  const CwDesign open = design_of(&table);
  assert_near(open.predicted_head, 10, 1e-4);
  assert_near(open.outlet_blade_angle, 18 * degree, 1e-12);
  table.impeller.outlet_blade_angle = 32 * degree;
  assert_true(design_of(&table).outlet_diameter > 1.01 * open.outlet_diameter);
}

// What else is given and cannot be had gives way to what can, and the design keeps what was asked.
static void given_values_give_way(void **state) {
  CwCase table = duty_point(54, 20, 1800);
  const CwDesign open = design_of(&table);
  assert_true(isnan(open.asked[CW_DESIGN_wrap_angle]));
  table.impeller.wrap_angle = 2.2 * open.wrap_angle;
  const CwDesign wrapped = design_of(&table);
  assert_near(wrapped.asked[CW_DESIGN_wrap_angle], table.impeller.wrap_angle, 1e-12);
  assert_true(wrapped.wrap_angle < table.impeller.wrap_angle && wrapped.wrap_angle > open.wrap_angle);
  CwDesign refused;
  table.impeller.priority = CW_PRIORITY_WRAP;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "wrap"));
  cw_fail_clear();

  table = duty_point(54, 20, 1800);
  table.impeller.root_fillet_radius = open.outlet_diameter / 10;
  const CwDesign rounded = design_of(&table);
  assert_near(rounded.asked[CW_DESIGN_root_fillet_radius], open.outlet_diameter / 10, 1e-12);
  assert_true(rounded.root_fillet_radius > 0 && rounded.root_fillet_radius < open.outlet_diameter / 10);
  assert_int_equal(rounded.trailing_edge, CW_EDGE_BEVELLED);
  assert_true(isnan(rounded.asked[CW_DESIGN_trailing_edge_bevel]));
  for (CwTrailingEdge edge = CW_EDGE_BLUNT; edge <= CW_EDGE_SHARP; edge++) { // a wedge of under 30 degrees
    table.impeller.trailing_edge = edge;
    const int feather = edge != CW_EDGE_ROUNDED;
    const CwDesign filleted = design_of(&table);
    assert_int_equal(filleted.trailing_edge, feather ? CW_EDGE_BEVELLED : edge);
    assert_int_equal(!isnan(filleted.asked[CW_DESIGN_trailing_edge_bevel]), feather);
    if (feather) assert_near(filleted.trailing_edge_bevel, rounded.trailing_edge_bevel, 1e-12);
  }
  table.impeller.root_fillet_radius = 0;
  assert_int_equal(design_of(&table).trailing_edge, CW_EDGE_SHARP);
  table.impeller.trailing_edge = CW_EDGE_ROUNDED; // which has no bevel
  assert_near(design_of(&table).trailing_edge_bevel, 0, 0);
  table.impeller.trailing_edge_bevel = 1e-3;
  assert_near(design_of(&table).trailing_edge_bevel, 0, 0);
  assert_near(design_of(&table).asked[CW_DESIGN_trailing_edge_bevel], 1e-3, 1e-15);

  table = duty_point(5.1582, 56.415, 48124); // nq 88, two short blades
  table.impeller.blade_count = 2;
  table.impeller.outlet_width = 3.068e-3;
  const CwDesign twisted = design_of(&table);
  table.impeller.blade_form = CW_BLADE_CYLINDRICAL;
  const CwDesign flat = design_of(&table);
  assert_int_equal(flat.blade_form, CW_BLADE_TWISTED);
  assert_false(isnan(flat.asked[CW_DESIGN_leading_edge_radius_shroud]));
  assert_near(flat.leading_edge_radius_shroud, twisted.leading_edge_radius_shroud, 1e-12);

  table = duty_point(2287.1, 1369.9, 6803.2); // whose shaft asks for a thick hub
  table.impeller.inlet_diameter = 0.85 * design_of(&table).inlet_diameter;
  assert_near(design_of(&table).hub_diameter, 0.65 * table.impeller.inlet_diameter, 1e-12);
}

// Blade angles from 5 to 85 degrees can be given, those from 12 to 60 be built: the refusal names the angle that was
// given, which no wrap changes.
static void given_angles_outside_the_range_are_named(void **state) {
  CwDesign refused;
  CwCase table = duty_point(54, 20, 1800);
  table.impeller.outlet_blade_angle = 65 * degree;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "12 to 60 deg are allowed: change outlet_blade_angle_deg"));
  table = duty_point(54, 20, 1800);
  table.impeller.inlet_blade_angle = 8 * degree;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "12 to 60 deg are allowed: change inlet_blade_angle_deg"));
  cw_fail_clear();
}

// A nut's end as wide as the hub, and a hub that leads beyond the interface, of which no table of given values tells.
static void hubs_that_cannot_be_are_refused(void **state) {
  CwDesign refused;
  CwCase table = duty_point(54, 20, 1800);
  table.impeller.nut_flat_diameter = 1.01 * design_of(&table).hub_diameter;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "lower hub_nut_flat_diameter_mm"));
  cw_fail_clear();
  table.impeller.nut_flat_diameter *= 0.9;
  design_of(&table);
  // From the hub of 12.5 mm 3 (50 - 12.5) mm lead to 125 mm, the interface lies at some 102 mm.
  table = duty_point(54, 20, 1800);
  table.impeller.outlet_diameter = 0.2;
  table.impeller.inlet_diameter = 0.1;
  table.impeller.hub_diameter = 0.025;
  table.impeller.hub_pole_radial = 3;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "lower hub_pole_radial to 2.1"));
  cw_fail_clear();
}

// With a shaft through the inlet nothing is left of a given end of the nut, or of the nut.
static void nut_gives_way_to_the_shaft(void **state) {
  CwCase table = duty_point(54, 20, 1800);
  const double hub = table.impeller.hub_diameter = 0.03;
  table.impeller.nut_flat_diameter = 0.01;
  table.impeller.nut_length = 0.02;
  table.impeller.through_shaft_diameter = 0.02;
  CwDesign design = design_of(&table);
  assert_near(design.nut_disk_radius, 0.01, 1e-15);
  assert_near(design.asked[CW_DESIGN_nut_disk_radius], 0.005, 1e-15);
  assert_near(design.nut_length, 0.02, 1e-15);
  assert_true(isnan(design.asked[CW_DESIGN_nut_length]));
  table.impeller.through_shaft_diameter = hub;
  design = design_of(&table);
  assert_near(design.nut_length, 0, 0);
  assert_near(design.asked[CW_DESIGN_nut_length], 0.02, 1e-15);
  assert_near(design.asked[CW_DESIGN_nut_disk_radius], 0.005, 1e-15);
}

// A shroud of 200 mm leaves a hub that begins 0.2 200 - 8 = 32 mm before the eye. Without a nut an open suction pipe is
// longer than that by 74/24 mm, where D1 / 3 is 24.7 mm.
static void suction_pipe_begins_before_the_hub(void **state) {
  CwCase table = paper();
  CwDesign design;
  table.impeller.hub_diameter = table.impeller.through_shaft_diameter = 0.024;
  table.impeller.axial_length = 0.2;
  cw_hydraulic_design(&table, &design); // whatever becomes of such a wheel
  assert_near(design.suction_pipe_length, 0.032 + 0.074 / 24, 1e-12);
  assert_null(strstr(cw_fail_message(), "suction_pipe_length_mm"));
  cw_fail_clear();
}

// A given wheel somewhat too small or too large for its head at any outlet blade angle: b2 meets the head. A given b2
// leaves nothing open.
static void open_outlet_width_meets_the_head_of_a_given_wheel(void **state) {
  CwCase table = duty_point(54, 20, 1800);
  table.impeller.priority = CW_PRIORITY_HEAD;
  const CwDesign open = design_of(&table);
  int wider = 0, narrower = 0;
  for (int way = -1; way <= 1; way += 2) {
    CwDesign design;
    for (int i = 1;; i++) {
      table.impeller.outlet_diameter = (1 + 0.01 * way * i) * open.outlet_diameter;
      if (cw_hydraulic_design(&table, &design) != CW_OK) break;
      assert_near(design.predicted_head, 20, 0.02);
      assert_near(design.outlet_diameter, table.impeller.outlet_diameter, 1e-12);
      wider += way < 0 && design.outlet_width > 1.001 * open.outlet_width;
      narrower += way > 0 && design.outlet_width < 0.999 * open.outlet_width;
    }
    cw_fail_clear();
  }
  assert_true(wider > 0 && narrower > 0);
  table.impeller.outlet_width = open.outlet_width;
  table.impeller.outlet_diameter = 0.8 * open.outlet_diameter;
  CwDesign refused;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "change outlet_diameter_mm"));
  cw_fail_clear();
}

// Cylindrical blades stand at 50 degrees or more on hub and shroud, also of wheels that draw twisted ones into the eye.
static void cylindrical_blades_stand_on_the_walls(void **state) {
  static const double duty[][3] = {{345.21, 1.1954, 268.54}, {28.578, 3.2085, 1141.8}, {54, 20, 1800}, {15, 20, 2900}};
  for (int i = 0; i < 4; i++) {
    CwCase table = duty_point(duty[i][0], duty[i][1], duty[i][2]);
    table.impeller.blade_form = CW_BLADE_CYLINDRICAL;
    const CwDesign design = design_of(&table);
    CwMeridian meridian;
    double angle;
    assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
    assert_int_equal(cw_blade_wall_angle(&design, &meridian, &angle), CW_OK);
    assert_true(angle >= 50 * degree);
    assert_near(design.leading_edge_radius_hub, design.leading_edge_radius_shroud, 1e-12);
    assert_near(design.predicted_head, duty[i][1], 1e-3 * duty[i][1]);
  }
  // A leading edge that is given in the eye gives way until they stand at 40 degrees; one outside stays.
  CwCase drawn_in = duty_point(duty[3][0], duty[3][1], duty[3][2]);
  drawn_in.impeller.blade_form = CW_BLADE_CYLINDRICAL;
  const double open = design_of(&drawn_in).leading_edge_radius_shroud;
  for (int out = 0; out < 2; out++) {
    CwMeridian meridian;
    double angle, given = out ? open : 0.6 * open;
    drawn_in.impeller.leading_edge_radius_shroud = given;
    const CwDesign design = design_of(&drawn_in);
    assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
    assert_int_equal(cw_blade_wall_angle(&design, &meridian, &angle), CW_OK);
    assert_true(angle >= 40 * degree);
    assert_int_equal(design.leading_edge_radius_shroud > given, !out);
    if (!out) assert_near(design.asked[CW_DESIGN_leading_edge_radius_shroud], given, 1e-12);
  }
  // A given wrap with no law for a blade that begins so far out gives way to the nearest step.
  CwCase table = duty_point(1680.3, 12.575, 314.56);
  table.fluid.kinematic_viscosity = 4.8245e-5;
  table.fluid.density = 972.54;
  table.impeller.blade_form = CW_BLADE_CYLINDRICAL;
  table.impeller.blade_count = 5;
  table.impeller.outlet_diameter = 1.0145;
  table.impeller.wrap_angle = 143.89 * degree;
  const CwDesign wrapped = design_of(&table);
  assert_near(wrapped.asked[CW_DESIGN_wrap_angle], 143.89 * degree, 1e-9);
  assert_near(wrapped.wrap_angle, 143.89 / 1.12 * degree, 1e-9);
  assert_near(wrapped.outlet_angle_residual, 0, 1e-9);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(open_outlet_diameter_stays_within_the_volute),
      cmocka_unit_test(open_outlet_width_meets_the_head_of_a_given_wheel),
      cmocka_unit_test(head_gives_way_to_given_dimensions),
      cmocka_unit_test(two_blades_meet_the_head),
      cmocka_unit_test(given_values_give_way),
      cmocka_unit_test(hubs_that_cannot_be_are_refused),
      cmocka_unit_test(nut_gives_way_to_the_shaft),
      cmocka_unit_test(suction_pipe_begins_before_the_hub),
      cmocka_unit_test(given_angles_outside_the_range_are_named),
      cmocka_unit_test(cylindrical_blades_stand_on_the_walls),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
