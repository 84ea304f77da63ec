// SPDX-License-Identifier: AGPL-3.0-or-later
// The inlet triangle of wheels whose leading edges fill much of the inlet.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "geometry/velocity_triangles.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;

// Twelve blades with 6.5 mm at the leading edge and a slow flow: at mid-span (r = 68.1 mm) z e / (2 pi r) = 0.182.
static CwCase thick_edges(void) {
  CwCase table = duty_point(18, 30, 1450);
  table.impeller.blade_count = 12;
  table.impeller.inlet_diameter = 0.11;
  table.impeller.leading_edge_thickness = 6.5e-3;
  table.impeller.blade_thickness = 7e-3;
  return table;
}

// u1 = 10.343 and c_m1 = 0.6148 m/s: 15.14 deg leave 1 - 0.182 / sin(15.14 deg) = 0.302 of the inlet open, where the
// flow comes at atan(0.6148 / 0.302 / 10.343) = 11.14 deg. A step by step approach would jump from side to side.
static void blades_meet_the_flow_between_them(void **state) {
  const CwCase table = thick_edges();
  const CwDesign d = design_of(&table);
  const double r = d.inlet_blade_speed / d.angular_speed, beta = d.inlet_blade_angle;
  const double blockage = 1 / (1 - 12 * 6.5e-3 / (2 * M_PI * r * sin(beta)));
  assert_near(d.inlet_blockage, blockage, 1e-9);
  assert_near(d.inlet_flow_angle, atan(blockage * d.inlet_meridional_speed / d.inlet_blade_speed), 1e-9);
  assert_near(d.incidence, 4 * degree, 1e-9);
  assert_near(beta, 15.14 * degree, 0.02 * degree);
}

// With the thickness and the number of blades that the refusal names the blades leave a way, with more they do not.
static void allowed_values_are_the_limits(const CwCase *table, const CwDesign *refused) {
  double thickness;
  int count;
  assert_int_equal(cw_inlet_check(table, refused), CW_ERR_DESIGN);
  const char *allowed = strstr(cw_fail_message(), "lower leading_edge_thickness_mm to less than ");
  assert_non_null(allowed);
  assert_int_equal(sscanf(allowed,
                          "lower leading_edge_thickness_mm to less than %lf, or lower blade_count to at most %d",
                          &thickness, &count),
                   2);
  cw_fail_clear();
  CwDesign design = *refused;
  design.leading_edge_thickness = 0.999e-3 * thickness;
  assert_int_equal(cw_inlet_check(table, &design), CW_OK);
  design.leading_edge_thickness = 1.001e-3 * thickness;
  assert_int_equal(cw_inlet_check(table, &design), CW_ERR_DESIGN);
  design = *refused;
  design.blade_count = count;
  assert_int_equal(cw_inlet_check(table, &design), CW_OK);
  design.blade_count = count + 1;
  assert_int_equal(cw_inlet_check(table, &design), CW_ERR_DESIGN);
  cw_fail_clear();
}

static void blades_that_fill_the_inlet_are_refused(void **state) {
  CwCase table = thick_edges();
  CwDesign design = design_of(&table);
  assert_int_equal(cw_inlet_check(&table, &design), CW_OK);
  // Of a given angle: 0.278 of the circumference over sin(13 deg) = 0.225.
  table.impeller.leading_edge_thickness = 9.9e-3;
  table.impeller.blade_thickness = 10e-3;
  table.impeller.inlet_blade_angle = 13 * degree;
  CwDesign refused;
  assert_int_equal(cw_hydraulic_design(&table, &refused), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "12 blades of leading_edge_thickness_mm 9.9 with beta1 = 13.00 deg"));
  cw_fail_clear();
  allowed_values_are_the_limits(&table, &refused);
  // Of an open one, with c_m1 = u1: at 60 deg less 4 the flow needs 1 / tan(56 deg) = 0.675 of the inlet.
  table = thick_edges();
  design.inlet_blade_angle = 60 * degree;
  design.inlet_meridional_speed = design.inlet_blade_speed;
  design.leading_edge_thickness = 10.5e-3; // 0.294 over 0.325 sin(60 deg) = 0.282
  allowed_values_are_the_limits(&table, &design);
  design.inlet_meridional_speed *= 2; // at 63 deg without any blade
  assert_int_equal(cw_inlet_check(&table, &design), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "the flow comes to the blades at 63.4 deg without their blockage"));
  assert_non_null(strstr(cw_fail_message(), "raise inlet_diameter_mm"));
  cw_fail_clear();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(blades_meet_the_flow_between_them),
      cmocka_unit_test(blades_that_fill_the_inlet_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
