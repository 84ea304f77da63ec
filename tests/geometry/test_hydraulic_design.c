// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "geometry/blade.h"
#include "geometry/design_value.h"
#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "geometry/velocity_triangles.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;

// omega = 1450 pi/30 = 151.844; u2 = 15.184; nq = 1450 (25/3600)^0.5 / 10^0.75 = 1450 0.083333 / 5.62341
// = 21.487; psi = 2 9.80665 10 / 15.184^2 = 0.8507; overlap 6 71 / 360 = 1.1833; suction 6.9444e-3
// / 4.3008e-3 = 1.6147.
static void paper_values_by_hand(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  assert_near(design.impeller_tip_speed, 15.184, 1e-3);
  assert_near(design.specific_speed_nq, 21.487, 1e-3);
  assert_near(design.specific_speed_ns, 78.43, 0.01);
  assert_near(design.head_coefficient, 0.8507, 1e-4);
  assert_near(design.overlap, 1.18333, 1e-5);
  assert_near(design.suction_speed, 1.6147, 1e-4);
  assert_near(design.outlet_meridional_speed, 6.94444e-3 / 5.026548e-3, 1e-5);
  assert_near(design.interface_radius, 0.101, 1e-12);
  assert_near(design.wrap_angle, 71 * degree, 1e-12);
  // m = 0.08 144^0.15 (45/21.487)^0.06 = 0.1763; 1 - 0.055 144^m - 0.2 (0.26 - lg(21.487/25))^2 144^0.1 =
  // 0.8331.
  assert_near(design.hydraulic_efficiency, 0.8331, 2e-4);
  assert_near(design.discharge_diameter, 0.050, 1e-12);
  assert_string_equal(design.source[CW_DESIGN_outlet_diameter], "case");
  for (int i = 0; i < CW_DESIGN_COUNT; i++) assert_non_null(design.source[i]);
}

// The triangle closes: w = (u2 - c_u2, c_m2), head = eta u2 c_u2 / g, blade angles in their allowed range.
static void velocity_triangles_close(void **state) {
  const CwCase table = paper();
  const CwDesign d = design_of(&table);
  assert_near(d.outlet_relative_speed * cos(d.outlet_flow_angle) + d.outlet_swirl_speed, d.impeller_tip_speed, 1e-12);
  assert_near(d.outlet_absolute_speed * sin(d.outlet_absolute_angle), d.outlet_meridional_speed, 1e-12);
  assert_near(d.predicted_head, d.hydraulic_efficiency * 15.18436 * d.outlet_swirl_speed / 9.80665, 1e-4);
  assert_near(d.head_residual, d.predicted_head - 10, 1e-12);
  assert_near(d.incidence, d.inlet_blade_angle - d.inlet_flow_angle, 1e-12);
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
  table.design.correlations = CW_CORRELATIONS_GUAN;
  for (size_t i = 0; i < sizeof by_hand / sizeof *by_hand; i++) {
    table.impeller.outlet_blade_angle = by_hand[i][0] * degree;
    assert_near(design_of(&table).predicted_head, by_hand[i][1], 0.08);
  }
}

// gamma = 0.98 (1 - sin(30 deg)^0.5 / 6^0.7) = 0.98 (1 - 0.70711 / 3.50514) = 0.78230; the leading edge lies
// inside the limit exp(-8.16 0.5 / 6) = 0.5066 of D2.
static void slip_by_hand(void **state) {
  CwCase table = paper();
  table.impeller.priority = CW_PRIORITY_BETA;
  table.impeller.outlet_blade_angle = 30 * degree;
  assert_near(design_of(&table).slip_factor, 0.78230, 1e-5);
}

// Two blades without blockage whose leading edge lies on the axis (k_w = 1), 2^0.7 = 1.62450: the head over u2^2/g is
// 0.98 (1 - sin(beta2)^0.5 / 1.62450) - phi / tan(beta2). By hand:
//   phi 0.03   30 deg 0.55343 - 0.05196 = 0.50147, on the way down: 12 deg 0.56378, 60 deg 0.40128
//   phi 0.091  22 deg 0.61077 - 0.22518 = 0.38559, and at 41.9 deg; the most at 29.5 deg, the least at 12
//   phi 0.05   15 deg 0.67309 - 0.18660 = 0.48649, and at 22.3 deg, which is usual
//   phi 0.07   16 deg 0.66328 - 0.24412 = 0.41916, 2 deg off the usual, and at 37.0 deg, 5 off
//   phi 0.06   13 deg 0.69388 - 0.25989 = 0.43399, 5 deg off the usual, and at 36.4 deg, 4.4 off
static void outlet_angle_where_the_head_falls_again(void **state) {
  static const double by_hand[][3] = {{0.03, 0.50147, 30}, {0.09098, 0.38559, 22}, {0.05, 0.48649, 22.29},
                                      {0.07, 0.41916, 16}, {0.06, 0.43399, 36.36}, {0.09098, 0.5, 29.5},
                                      {0.09098, 0.1, 12}};
  const double range[2] = {12 * degree, 60 * degree}, usual[2] = {18 * degree, 32 * degree};
  const CwCase table = paper();
  CwDesign design = design_of(&table);
  CwMeridian meridian;
  assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
  design.blade_count = 2;
  design.leading_edge_radius_hub = design.leading_edge_radius_shroud = design.trailing_edge_thickness = 0;
  design.hydraulic_efficiency = design.viscous_head_factor = 1;
  const double u2 = design.impeller_tip_speed, area = M_PI * design.outlet_diameter * design.outlet_width;
  for (size_t i = 0; i < sizeof by_hand / sizeof *by_hand; i++) {
    design.water_flow_rate = by_hand[i][0] * u2 * area;
    design.head = by_hand[i][1] * u2 * u2 / 9.80665;
    const double angle = cw_outlet_angle_for_head(&meridian, range, usual, &design);
    assert_near(angle / degree, by_hand[i][2], 0.02);
    assert_near(design.outlet_blade_angle, angle, 0);
    if (i < 5) assert_near(design.head_residual, 0, 1e-9);
  }
}

static void head_priority_meets_the_head(void **state) {
  CwCase table = paper();
  table.impeller.priority = CW_PRIORITY_HEAD;
  table.design.correlations = CW_CORRELATIONS_GUAN;
  const CwDesign design = design_of(&table);
  assert_near(design.predicted_head, 10, 1e-6);
  // c_u2 = g H / (eta u2) = 98.0665 / (0.85193 15.18436) = 7.5809; K = 0.75809.
  assert_near(design.swirl_constant, 0.75809, 1e-4);
  assert_true(design.outlet_blade_angle < 22 * degree);
  assert_true(design.wrap_residual > 20 * degree);
}

// From the duty point alone: Guelich psi = 1.21 exp(-0.77 0.21487) = 1.02545, D2 = 2/151.844
// (196.133/1.02545)^0.5 = 182.2 mm, where beta2 = 20 deg meets the head. ns = 78.4, Ns = 51.65 21.487 = 1110,
// type number 21.487 / 52.92.
static void duty_point_is_enough(void **state) {
  CwCase table = duty_point(25, 10, 1450);
  CwDesign design = design_of(&table);
  assert_near(design.outlet_diameter, 0.1822, 1e-4);
  assert_near(design.predicted_head, 10, 1e-6);
  assert_int_equal(design.priority, CW_PRIORITY_HEAD);
  assert_int_equal(design.blade_count, 6);
  assert_near(design.specific_speed_us, 1109.7, 0.5);
  assert_near(design.type_number, 0.4060, 2e-4);
  assert_true(design.outlet_blade_angle > 18 * degree && design.outlet_blade_angle < 32 * degree);
  assert_near(design.incidence, 4 * degree, 1e-9);
  assert_string_not_equal(design.source[CW_DESIGN_outlet_diameter], "case");
  for (int i = 0; i < CW_DESIGN_COUNT; i++) assert_non_null(design.source[i]);
  table.design.correlations = CW_CORRELATIONS_GUAN;
  design = design_of(&table);
  assert_near(design.predicted_head, 10, 1e-6);
  assert_near(design.incidence, 6 * degree, 1e-9);
  // Guan's efficiency 0.852 and D2 = 9.35 0.7843^-0.5 0.016856 = 178 mm, kept or corrected for the head.
  assert_near(design.outlet_diameter, 0.178, 0.012);
}

// With D2 open and beta2 given, D2 meets the head.
static void open_outlet_diameter_meets_the_head(void **state) {
  CwCase table = duty_point(25, 10, 1450);
  table.impeller.outlet_blade_angle = 26 * degree;
  const CwDesign design = design_of(&table);
  assert_int_equal(design.priority, CW_PRIORITY_BETA);
  assert_near(design.outlet_blade_angle, 26 * degree, 1e-12);
  assert_near(design.predicted_head, 10, 1e-6);
  assert_true(design.outlet_diameter < 0.1822);
}

// p = 0.65 (1 + 25/60) 0.1^2 / (6 S), S = 0.00375 m2 (r from 0.05 to 0.1, radial): 0.40926; by Pfleiderer
// H_inf / H.
static void pfleiderer_by_hand(void **state) {
  assert_near(cw_slip_pfleiderer(6, 25 * degree, 0.1, 0.00375), 0.65 * (85.0 / 60) * 0.01 / 0.0225, 1e-12);
  CwCase table = paper();
  table.design.slip = CW_SLIP_PFLEIDERER;
  const CwDesign d = design_of(&table);
  assert_near(d.predicted_head, d.predicted_head_pfleiderer, 1e-12);
  assert_true(fabs(d.predicted_head_wiesner - d.predicted_head) > 0.01);
}

// Triangles at hub, mid-span and shroud: u = omega r, no swirl, and tan beta1 r is even.
static void triangles_over_the_span(void **state) {
  const CwCase table = paper();
  const CwDesign d = design_of(&table);
  for (int j = 0; j < CW_TRIANGLE_SPANS; j++) {
    const CwTriangle *t = &d.inlet_triangle[j], *mean = &d.inlet_triangle[1];
    assert_near(t->u, d.angular_speed * t->radius, 1e-12);
    assert_near(t->w * t->w, t->u * t->u + t->c_m * t->c_m, 1e-9);
    assert_near(t->radius * tan(t->blade_angle), mean->radius * tan(mean->blade_angle), 1e-9);
    assert_near(d.outlet_triangle[j].blade_angle, d.outlet_blade_angle, 1e-12);
  }
  assert_near(d.inlet_triangle[1].flow_angle, d.inlet_flow_angle, 1e-12);
  assert_near(d.inlet_triangle[0].radius, d.leading_edge_radius_hub, 1e-9);
}

// Splitters from q = 0.4 count for the slip by 0.6 of a blade: z = 9.6 in Wiesner's formula with 25 deg:
// 0.98 (1 - 0.65009 / 4.8733) = 0.8493. In the middle of the passage they leave less than half of its throat.
static void splitters_raise_the_slip_factor(void **state) {
  CwCase table = paper();
  table.impeller.priority = CW_PRIORITY_BETA;
  table.impeller.outlet_blade_angle = 25 * degree;
  const double whole = design_of(&table).outlet_throat_width;
  table.impeller.splitter_start = 0.4;
  table.impeller.splitter_position = 0.5;
  const CwDesign design = design_of(&table);
  assert_near(design.slip_factor, 0.8493, 1e-3);
  assert_true(design.outlet_throat_width > 0.3 * whole && design.outlet_throat_width < 0.55 * whole);
}

// 50 m3/h and 32 m at 2900 rpm with 200 cSt: the pump for water has Q / C_Q and H / C_H by ANSI/HI 9.6.7. With C = 0.90
// B = 16.5 14.142 1.2456 / (4.512 7.338) = 8.78 (Q 55.6, H 35.6), lg B = 0.9435, C = exp(-0.165 0.8326) = 0.8717; with
// C = 0.872 B = 8.69, C = 0.8728; and C_eta = 8.69^(-0.0547 4.447) = 0.591.
static void viscous_fluid_by_hand(void **state) {
  CwCase table = duty_point(50, 32, 2900);
  const CwDesign water = design_of(&table);
  table.fluid.kinematic_viscosity = 200e-6;
  const CwDesign design = design_of(&table);
  assert_near(design.viscous_head_factor, 0.8728, 1e-3);
  assert_near(design.viscous_efficiency_factor, 0.591, 2e-3);
  assert_near(design.water_head, 32 / design.viscous_head_factor, 1e-9);
  assert_near(design.predicted_head, 32, 1e-4);
  assert_near(design.theoretical_head * design.hydraulic_efficiency * design.viscous_head_factor, 32, 1e-4);
  assert_true(design.outlet_diameter > 1.05 * water.outlet_diameter);
  assert_true(design.efficiency < 0.65 * water.efficiency);
  // The spiral takes up the water's flow, the pipe's bore is chosen for what flows there.
  assert_near(design.volute.input.flow_rate, design.water_flow_rate, 1e-15);
  assert_near(design.volute.input.pipe_flow_rate, 50 / 3600.0, 1e-15);
  // The same wheel as that of water for the water's duty.
  CwCase larger = duty_point(3600 * design.water_flow_rate, design.water_head, 2900);
  assert_near(design_of(&larger).outlet_diameter, design.outlet_diameter, 1e-6);
}

// Given at the eye or inside it the leading edge begins just behind the eye's plane, and no range is refused.
static void leading_edge_at_the_eye(void **state) {
  for (double share = 0.4; share < 0.51; share += 0.05) {
    CwCase table = paper();
    table.impeller.leading_edge_radius_shroud = share * table.impeller.inlet_diameter;
    const CwDesign design = design_of(&table);
    assert_true(design.leading_edge_radius_shroud >= 0.5 * table.impeller.inlet_diameter);
    assert_near(design.leading_edge_radius_shroud, 0.5 * table.impeller.inlet_diameter, 2e-4);
    assert_true(design.leading_edge_radius_hub > 0.5 * design.hub_diameter);
  }
}

// Guelich's efficiencies go on below 18 m3/h without a jump of value or slope, and fall to 0 and not below.
static void efficiency_of_small_pumps(void **state) {
  CwDesign before = {.flow_rate = 0};
  for (double q = 100; q > 0.02; q *= 0.65) {
    CwCase table = duty_point(q, 1450 * 1450, 1450);
    table.operating_point.head = pow(1450 * sqrt(q / 3600) / 20, 4.0 / 3);
    table.fluid.kinematic_viscosity = 1e-6;
    CwDesign design;
    if (cw_hydraulic_design(&table, &design) != CW_OK) fail_msg("%g m3/h: %s", q, cw_fail_message());
    assert_true(design.efficiency > 0.01 && design.hydraulic_efficiency > 0.2);
    if (before.flow_rate > 0) {
      const double fall = before.efficiency - design.efficiency;
      assert_true(fall > 0 && fall < 0.17);
    }
    before = design;
  }
  assert_true(before.efficiency < 0.1);
}

// A given incidence is met where the blade angle at the inlet is open; else what goes before it is told, with both.
static void incidence_gives_way(void **state) {
  CwCase table = duty_point(25, 10, 1450);
  table.impeller.incidence = 2 * degree;
  CwDesign design = design_of(&table);
  assert_near(design.incidence, 2 * degree, 1e-6);
  assert_true(isnan(design.asked[CW_DESIGN_incidence]));
  table.impeller.inlet_blade_angle = design.inlet_blade_angle + 5 * degree;
  design = design_of(&table);
  assert_true(design.incidence > 6 * degree);
  assert_near(design.asked[CW_DESIGN_incidence], 2 * degree, 1e-12);
  table = paper(); // whose wrap leaves 16 degrees
  table.impeller.incidence = 2 * degree;
  design = design_of(&table);
  assert_near(design.asked[CW_DESIGN_incidence], 2 * degree, 1e-12);
}

// At the vapour pressure of 47.4 kPa of water at 80 degrees Celsius: (101325 - 47400) / (971.8 9.80665) = 5.66 m.
static void npsh_at_the_vapour_pressure(void **state) {
  CwCase table = paper();
  table.fluid.vapour_pressure = 47400;
  table.fluid.density = 971.8;
  assert_near(design_of(&table).npsh_available, 5.658, 1e-3);
}

// Useful power 998.2 9.80665 25/3600 10 = 679.79 W, n Q^0.5 = 120.83; the triangle at the shroud for the NPSH; the
// speeds from which the first heights of the layers follow; and throats of six passages between b2 and half the eye
// wide.
static void powers_and_speeds(void **state) {
  const CwCase table = paper();
  const CwDesign d = design_of(&table);
  const double u = d.inlet_triangle[2].u, cm = d.inlet_meridional_speed, w = hypot(u, cm);
  assert_near(d.shaft_power * d.efficiency, 679.79, 0.01);
  assert_near(d.npsh_required * 2 * 9.80665,
              1.1 * cm * cm + 0.3 * pow(tan(d.inlet_triangle[2].blade_angle), 0.57) * w * w, 1e-9);
  assert_near(d.suction_specific_speed * pow(d.npsh_required, 0.75), 120.833, 1e-3);
  assert_near(2 * d.relative_speed, d.inlet_relative_speed + d.outlet_relative_speed, 1e-12);
  assert_near(2 * d.volute_speed, d.swirl_constant / 0.102 + d.throat_speed, 1e-9);
  assert_near(d.discharge_speed, 25.0 / 3600 / (M_PI / 4 * 0.05 * 0.05), 1e-9);
  assert_near(d.inlet_throat_ratio * d.inlet_throat_area * d.inlet_relative_speed, 25.0 / 3600, 1e-12);
  const double width = d.inlet_throat_area / (6 * d.inlet_throat_width);
  assert_true(width > 8e-3 && width < 37e-3);
  assert_near(1 - 1 / d.outlet_blockage, 6 * d.trailing_edge_thickness / (M_PI * 0.2 * sin(d.outlet_blade_angle)),
              1e-6);
}

// A shaft of 20 mm leaves pi/4 (74^2 - 20^2) = 3986.7 mm2 of the suction pipe: 6.9444e-3 / 3.9867e-3 = 1.7419 m/s.
static void shaft_narrows_the_suction_pipe(void **state) {
  CwCase table = paper();
  table.impeller.hub_diameter = 0.024;
  table.impeller.through_shaft_diameter = 0.02;
  assert_near(design_of(&table).suction_speed, 1.7419, 1e-4);
}

static void case_overrides(void **state) {
  CwCase table = paper();
  table.impeller.hub_diameter = 0.028;
  table.impeller.inlet_blade_angle = 27 * degree;
  table.impeller.trailing_edge_bevel = 0.7e-3;
  table.impeller.suction_pipe_length = 0.1;
  const CwDesign design = design_of(&table);
  assert_near(design.hub_diameter, 0.028, 0);
  assert_near(design.inlet_blade_angle, 27 * degree, 0);
  assert_near(design.trailing_edge_bevel, 0.7e-3, 0);
  assert_near(design.suction_pipe_length, 0.1, 0);
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

static double reach_of(const CwDesign *design) {
  CwMeridian meridian;
  CwBladeSeams seams;
  assert_int_equal(cw_meridian_make(design, &meridian), CW_OK);
  assert_int_equal(cw_blade_seams(design, &meridian, &seams), CW_OK);
  return seams.reach;
}

// Two blades and two splitters: half a revolution of pitch, and a wrap that leaves no room for it; that of a given
// blade angle is left for the geometry to refuse. A D2 that would miss the head with another wrap leaves it too.
static void wraps_stay_within_a_revolution(void **state) {
  CwCase table = duty_point(25, 40, 1450);
  table.impeller.blade_count = 2;
  table.impeller.splitter_start = 0.4;
  table.impeller.outlet_blade_angle = 18 * M_PI / 180;
  const CwDesign wound = design_of(&table);
  assert_int_equal(wound.priority, CW_PRIORITY_BETA);
  assert_true(reach_of(&wound) > CW_SEAM_REACH_MOST);
  table.impeller.outlet_blade_angle = NAN;
  CwDesign design;
  for (int strict = 0; strict < 2; strict++) {
    table.impeller.priority = strict ? CW_PRIORITY_HEAD : CW_PRIORITY_AUTO;
    design = design_of(&table);
    assert_string_equal(design.source[CW_DESIGN_wrap_angle], CW_WRAP_WITHIN_A_REVOLUTION);
    assert_true(reach_of(&design) > 0.9 * CW_SEAM_REACH_MOST && reach_of(&design) <= CW_SEAM_REACH_MOST);
    assert_near(design.predicted_head, 40, 1e-6);
  }
  table.impeller.outlet_diameter = wound.outlet_diameter;
  design = design_of(&table);
  assert_near(design.wrap_angle, wound.wrap_angle, 1e-6);
  table = duty_point(25, 40, 1450);
  design = design_of(&table);
  assert_string_not_equal(design.source[CW_DESIGN_wrap_angle], CW_WRAP_WITHIN_A_REVOLUTION);
}

// Nine blades and nine splitters leave no room for root fillets of 10 mm: they become those that fit, but for a
// twentieth, and what fits stays as it is.
static void fillets_need_room_between_the_blades(void **state) {
  CwCase table = paper();
  table.impeller.blade_count = 9;
  table.impeller.splitter_start = 0.4;
  table.impeller.root_fillet_radius = 10e-3;
  const double fits = design_of(&table).root_fillet_radius;
  assert_near(design_of(&table).asked[CW_DESIGN_root_fillet_radius], 10e-3, 1e-12);
  assert_true(fits > 0.1e-3 && fits < 10e-3);
  table.impeller.root_fillet_radius = 1.04 * fits;
  assert_near(design_of(&table).root_fillet_radius, 1.04 * fits, 1e-12);
  table.impeller.root_fillet_radius = 1.06 * fits;
  assert_near(design_of(&table).root_fillet_radius, fits, 1e-12);
}

// A ball of radius R in a crease of 45 to 90 degrees reaches 1.71 to 1 R up the blade: two of them take 85 % of it.
static void fillets_need_room_on_the_blade(void **state) {
  CwCase table = paper();
  table.impeller.blade_count = 3;
  const double b2 = design_of(&table).outlet_width;
  table.impeller.root_fillet_radius = 0.5 * b2;
  const CwDesign found = design_of(&table);
  const double fits = found.root_fillet_radius;
  assert_string_equal(found.source[CW_DESIGN_root_fillet_radius],
                      "root_fillet_radius_mm gives way to the blade's height between fillets");
  assert_near(found.asked[CW_DESIGN_root_fillet_radius], 0.5 * b2, 1e-12);
  assert_true(2 * fits <= 0.85 * b2 && 2 * 1.71 * fits >= 0.95 * 0.85 * b2);
  table.impeller.root_fillet_radius = 1.04 * fits;
  assert_near(design_of(&table).root_fillet_radius, 1.04 * fits, 1e-12);
  table.impeller.root_fillet_radius = 1.06 * fits;
  assert_near(design_of(&table).root_fillet_radius, fits, 1e-12);
}

// The chord of a fillet in a crease of 90 degrees is 1.41 R, in one of 135 degrees 0.77 R; faces are 0.0002 D2 wide.
static void fillets_narrower_than_faces_are_left_out(void **state) {
  CwCase table = paper();
  const double d2 = design_of(&table).outlet_diameter;
  table.impeller.root_fillet_radius = 2e-4 / 1.42 * d2;
  assert_near(design_of(&table).root_fillet_radius, 0, 0);
  assert_near(design_of(&table).asked[CW_DESIGN_root_fillet_radius], 2e-4 / 1.42 * d2, 1e-12);
  table.impeller.root_fillet_radius = 2e-4 / 0.76 * d2;
  assert_near(design_of(&table).root_fillet_radius, 2e-4 / 0.76 * d2, 1e-12);
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
      cmocka_unit_test(outlet_angle_where_the_head_falls_again),
      cmocka_unit_test(head_priority_meets_the_head),
      cmocka_unit_test(duty_point_is_enough),
      cmocka_unit_test(open_outlet_diameter_meets_the_head),
      cmocka_unit_test(pfleiderer_by_hand),
      cmocka_unit_test(triangles_over_the_span),
      cmocka_unit_test(splitters_raise_the_slip_factor),
      cmocka_unit_test(viscous_fluid_by_hand),
      cmocka_unit_test(leading_edge_at_the_eye),
      cmocka_unit_test(efficiency_of_small_pumps),
      cmocka_unit_test(incidence_gives_way),
      cmocka_unit_test(npsh_at_the_vapour_pressure),
      cmocka_unit_test(powers_and_speeds),
      cmocka_unit_test(shaft_narrows_the_suction_pipe),
      cmocka_unit_test(case_overrides),
      cmocka_unit_test(impossible_wrap_is_refused),
      cmocka_unit_test(wraps_stay_within_a_revolution),
      cmocka_unit_test(fillets_need_room_between_the_blades),
      cmocka_unit_test(fillets_need_room_on_the_blade),
      cmocka_unit_test(fillets_narrower_than_faces_are_left_out),
      cmocka_unit_test(rows_are_lines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
