// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "geometry/hydraulic_design.h"
#include "pipeline/case.h"

static const double degree = M_PI / 180;

static CwCase paper(void) {
  CwCase table;
  assert_int_equal(cw_case_read(CUTWATER_SOURCE_DIR "/cases/paper/case.yaml", &table), CW_OK);
  return table;
}

static void near_to(double value, double expected, double tolerance) {
  if (!(fabs(value - expected) <= tolerance))
    fail_msg("%.10g is not %.10g within %.3g", value, expected, tolerance);
}

static CwDesign design_of(const CwCase *table) {
  CwDesign design;
  if (cw_hydraulic_design(table, &design) != CW_OK)
    fail_msg("%s", cw_fail_message());
  return design;
}

// omega = 1450 pi/30 = 151.844; u2 = 15.184; nq = 1450 (25/3600)^0.5 / 10^0.75 = 1450 0.083333 / 5.62341
// = 21.487; psi = 2 9.80665 10 / 15.184^2 = 0.8507; overlap 6 71 / 360 = 1.1833; suction 6.9444e-3
// / 4.3008e-3 = 1.6147.
static void paper_values_by_hand(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  near_to(design.impeller_tip_speed, 15.184, 1e-3);
  near_to(design.specific_speed_nq, 21.487, 1e-3);
  near_to(design.specific_speed_ns, 78.43, 0.01);
  near_to(design.head_coefficient, 0.8507, 1e-4);
  near_to(design.overlap, 1.18333, 1e-5);
  near_to(design.suction_speed, 1.6147, 1e-4);
  near_to(design.outlet_meridional_speed, 6.94444e-3 / 5.026548e-3, 1e-5);
  near_to(design.interface_radius, 0.101, 1e-12);
  near_to(design.wrap_angle, 71 * degree, 1e-12);
  near_to(design.hydraulic_efficiency, 0.852, 5e-4);
  near_to(design.discharge_diameter, 0.050, 1e-12);
  assert_string_equal(design.source[CW_DESIGN_outlet_diameter], "case");
  for (int i = 0; i < CW_DESIGN_COUNT; i++)
    assert_non_null(design.source[i]);
}

// The triangle closes: w = (u2 - c_u2, c_m2), head = eta u2 c_u2 / g, blade angles in their allowed range.
static void velocity_triangles_close(void **state) {
  const CwCase table = paper();
  const CwDesign d = design_of(&table);
  near_to(d.outlet_relative_speed * cos(d.outlet_flow_angle) + d.outlet_swirl_speed, d.impeller_tip_speed,
          1e-12);
  near_to(d.outlet_absolute_speed * sin(d.outlet_absolute_angle), d.outlet_meridional_speed, 1e-12);
  near_to(d.predicted_head, d.hydraulic_efficiency * 15.18436 * d.outlet_swirl_speed / 9.80665, 1e-4);
  near_to(d.head_residual, d.predicted_head - 10, 1e-12);
  near_to(d.incidence, d.inlet_blade_angle - d.inlet_flow_angle, 1e-12);
  assert_true(d.inlet_blade_angle > 12 * degree && d.outlet_blade_angle < 45 * degree);
  assert_true(d.slip_factor > 0.7 && d.slip_factor < 0.85);
}

// Worked by hand with e = 3 mm, z = 6, D2 = 200 mm, b2 = 8 mm and eta_h = 0.85:
// beta2 16 -> 9.6 m, 20 -> 10.9 m, 25 -> 11.8 m, 30 -> 12.3 m, 35 -> 12.6 m.
static void head_over_outlet_angle(void **state) {
  static const double by_hand[][2] = {{16, 9.6}, {18, 10.3}, {20, 10.9}, {25, 11.8}, {30, 12.3}, {35, 12.6}};
  CwCase table = paper();
  table.impeller.priority = CW_PRIORITY_BETA;
  table.impeller.trailing_edge_thickness = 3e-3;
  for (size_t i = 0; i < sizeof by_hand / sizeof *by_hand; i++) {
    table.impeller.outlet_blade_angle = by_hand[i][0] * degree;
    near_to(design_of(&table).predicted_head, by_hand[i][1], 0.08);
  }
}

// gamma = 0.98 (1 - sin(30 deg)^0.5 / 6^0.7) = 0.98 (1 - 0.70711 / 3.50514) = 0.78230; the leading edge lies
// inside the limit exp(-8.16 0.5 / 6) = 0.5066 of D2.
static void slip_by_hand(void **state) {
  CwCase table = paper();
  table.impeller.priority = CW_PRIORITY_BETA;
  table.impeller.outlet_blade_angle = 30 * degree;
  near_to(design_of(&table).slip_factor, 0.78230, 1e-5);
}

static void head_priority_meets_the_head(void **state) {
  CwCase table = paper();
  table.impeller.priority = CW_PRIORITY_HEAD;
  const CwDesign design = design_of(&table);
  near_to(design.predicted_head, 10, 1e-6);
  // c_u2 = g H / (eta u2) = 98.0665 / (0.85193 15.18436) = 7.5809; K = 0.75809.
  near_to(design.swirl_constant, 0.75809, 1e-4);
  assert_true(design.outlet_blade_angle < 22 * degree);
  assert_true(design.wrap_residual > 20 * degree);
}

// Guan b2 = 0.64 (0.7843)^(5/6) (6.9444e-3/1450)^(1/3) = 0.64 0.81674 0.016856 = 8.811 mm;
// Gulich psi = 1.21 exp(-0.77 0.21487) = 1.02545, D2 = 2/151.844 (196.133/1.02545)^0.5 = 182.2 mm.
static void open_dimensions_by_correlation(void **state) {
  CwCase table = paper();
  table.impeller.outlet_width = NAN;
  near_to(design_of(&table).outlet_width, 8.811e-3, 5e-6);
  table = paper();
  table.impeller.priority = CW_PRIORITY_BETA;
  table.impeller.outlet_diameter = table.volute.base_diameter = NAN;
  const CwDesign design = design_of(&table);
  near_to(design.outlet_diameter, 0.1822, 1e-4);
  near_to(design.base_diameter, 1.02 * design.outlet_diameter, 1e-12);
  assert_string_not_equal(design.source[CW_DESIGN_outlet_diameter], "case");
}

static void case_overrides(void **state) {
  CwCase table = paper();
  table.impeller.hub_diameter = 0.028;
  table.impeller.inlet_blade_angle = 27 * degree;
  table.impeller.trailing_edge_bevel = 0.7e-3;
  table.impeller.suction_pipe_length = 0.1;
  const CwDesign design = design_of(&table);
  near_to(design.hub_diameter, 0.028, 0);
  near_to(design.inlet_blade_angle, 27 * degree, 0);
  near_to(design.trailing_edge_bevel, 0.7e-3, 0);
  near_to(design.suction_pipe_length, 0.1, 0);
  assert_string_equal(design.source[CW_DESIGN_hub_diameter], "case");
}

static void impossible_wrap_is_refused(void **state) {
  CwCase table = paper();
  CwDesign design;
  table.impeller.wrap_angle = 25 * degree;
  assert_int_equal(cw_hydraulic_design(&table, &design), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "wrap"));
  table = paper();
  table.operating_point.head = 30;
  table.impeller.priority = CW_PRIORITY_HEAD;
  assert_int_equal(cw_hydraulic_design(&table, &design), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "head"));
  cw_fail_clear();
}

static void rows_are_lines(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  char line[200];
  cw_hydraulic_design_row(&design, CW_DESIGN_outlet_diameter, line, sizeof line);
  assert_non_null(strstr(line, "impeller outlet D2"));
  assert_non_null(strstr(line, "200 mm"));
  assert_non_null(strstr(line, "case"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(paper_values_by_hand),
      cmocka_unit_test(velocity_triangles_close),
      cmocka_unit_test(head_over_outlet_angle),
      cmocka_unit_test(slip_by_hand),
      cmocka_unit_test(head_priority_meets_the_head),
      cmocka_unit_test(open_dimensions_by_correlation),
      cmocka_unit_test(case_overrides),
      cmocka_unit_test(impossible_wrap_is_refused),
      cmocka_unit_test(rows_are_lines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
