// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/hydraulic_design.h"

#include <math.h>

#include "geometry/blade.h"
#include "geometry/correlations.h"
#include "geometry/design_source.h"
#include "geometry/design_volute.h"
#include "geometry/meridian.h"
#include "geometry/meridian_passage.h"
#include "geometry/meridian_shape.h"
#include "geometry/velocity_triangles.h"
#include "geometry/viscous_correction.h"
#include "pipeline/water.h"

static const double gravity = 9.80665;
static const double degree = M_PI / 180;

// The family's value of a quantity with the design so far.
#define CORRELATED(quantity) cw_correlation(design->correlations, quantity, design, &source)

// The duty point with water to which that of the fluid corresponds.
static void water_duty(const CwCase *table, CwDesign *design) {
  SET(viscosity, table->fluid.kinematic_viscosity, "case or its default");
  const CwViscousCorrection c =
      cw_viscous_selection(design->viscosity, design->flow_rate, design->head, design->angular_speed);
  SET(viscous_parameter, c.parameter, "ANSI/HI 9.6.7: 16.5 nu^0.5 H^0.0625 / (Q^0.375 n^0.25)");
  SET(viscous_head_factor, c.head, "ANSI/HI 9.6.7: exp(-0.165 (lg B)^3.15), over that of water");
  SET(viscous_efficiency_factor, c.efficiency, "ANSI/HI 9.6.7: B^(-0.0547 B^0.69), over that of water");
  SET(water_flow_rate, design->flow_rate / c.head, "Q / C_Q");
  SET(water_head, design->head / c.head, "H / C_H");
}

static void specific_speeds(const CwCase *table, CwDesign *design) {
  const double q = design->water_flow_rate, h = design->water_head, omega = design->angular_speed;
  const double rpm = omega * 30 / M_PI;
  const char *source;
  double value;
  SET(specific_speed_nq, rpm * sqrt(q) / pow(h, 0.75), "n Q^0.5 / H^0.75 with water, rpm, m3/s, m");
  SET(specific_speed_ns, 3.65 * design->specific_speed_nq, "3.65 nq");
  SET(specific_speed_us, rpm * sqrt(q * 60e12 / 3785411784.0) / pow(h / 0.3048, 0.75), "n Q^0.5 / H^0.75");
  SET(type_number, omega * sqrt(q) / pow(gravity * h, 0.75), "omega Q^0.5 / (g H)^0.75, ISO 2548");
  value = CORRELATED(CW_CORRELATED_EFFICIENCY);
  SET(efficiency, value * design->viscous_efficiency_factor, source);
  value = CORRELATED(CW_CORRELATED_HYDRAULIC_EFFICIENCY);
  SET(hydraulic_efficiency, value, source);
  SET(shaft_power, table->fluid.density * gravity * design->flow_rate * design->head / design->efficiency,
      "rho g Q H / efficiency");
  value = CORRELATED(CW_CORRELATED_SHAFT_DIAMETER);
  SET(shaft_diameter, value, source);
}

// D3 over D2 at least, where D3 is given and D2 is not; usual are 1.03 to 1.08.
static const double LEAST_BASE = 1.02;

static double largest_outlet_diameter(const CwCase *table) {
  return cw_case_given(table->volute.base_diameter) ? table->volute.base_diameter / LEAST_BASE : INFINITY;
}

static void main_dimensions(const CwCase *table, double outlet_diameter, CwDesign *design) {
  const CwImpellerTable *given = &table->impeller;
  const char *source;
  const double largest = largest_outlet_diameter(table);
  double value = CORRELATED(CW_CORRELATED_OUTLET_DIAMETER);
  TAKE(outlet_diameter, given->outlet_diameter, fmin(value, largest), value > largest ? "D3 / 1.02" : source);
  if (cw_case_given(outlet_diameter))
    SET(outlet_diameter, outlet_diameter, "meets the head with the outlet blade angle");
  const double d2 = design->outlet_diameter, nq = design->specific_speed_nq;
  value = CORRELATED(CW_CORRELATED_HUB_DIAMETER);
  if (value < given->through_shaft_diameter) {
    value = given->through_shaft_diameter;
    source = "that of the shaft through the inlet";
  }
  TAKE(hub_diameter, given->hub_diameter, value, source);
  value = CORRELATED(CW_CORRELATED_OUTLET_WIDTH);
  TAKE(outlet_width, given->outlet_width, value, source);
  SET(impeller_tip_speed, design->angular_speed * d2 / 2, "omega D2 / 2");
  SET(head_coefficient, 2 * gravity * design->water_head / pow(design->impeller_tip_speed, 2), "2 g H / u2^2");
  value = CORRELATED(CW_CORRELATED_INLET_DIAMETER);
  TAKE(inlet_diameter, given->inlet_diameter, fmin(value, 0.78 * d2), value > 0.78 * d2 ? "at most 0.78 D2" : source);
  const double d1 = design->inlet_diameter;
  TAKE(axial_length, given->axial_length, (d2 - d1) * pow(nq / 74, 1.07), "Guelich: (D2 - D1) (nq/74)^1.07");
  // A shaft as thick as the hub leaves no nut.
  const double shaft = given->through_shaft_diameter;
  SET(through_shaft_diameter, fmin(shaft, design->hub_diameter), shaft > 0 ? "case" : "none");
  if (shaft > 0 && shaft > (1 - 1e-9) * design->hub_diameter) {
    SET(nut_length, 0, "none: the shaft is as thick as the hub");
    SET(nut_disk_radius, design->hub_diameter / 2, "the shaft's");
  } else {
    TAKE(nut_length, given->nut_length, 7.0 / 12 * (design->hub_diameter - shaft),
         shaft > 0 ? "7/12 of the hub's diameter over the shaft's" : "7/12 hub diameter");
    TAKE(nut_disk_radius, shaft > 0 ? shaft / 2 : given->nut_flat_diameter / 2, 0.145 * design->hub_diameter,
         "0.145 hub diameter");
  }
  SET(root_fillet_radius, given->root_fillet_radius, "case or its default");
  value = CORRELATED(CW_CORRELATED_BLADE_COUNT);
  design->blade_count = given->blade_count ? given->blade_count : (int)value;
  design->blade_count_source = given->blade_count ? "case" : source;
  value = CORRELATED(CW_CORRELATED_BLADE_THICKNESS);
  TAKE(blade_thickness, given->blade_thickness, value, source);
  TAKE(leading_edge_thickness, given->leading_edge_thickness, 0.70 * design->blade_thickness, "0.70 of the largest");
  TAKE(trailing_edge_thickness, given->trailing_edge_thickness, 0.50 * design->blade_thickness, "0.50 of the largest");
  TAKE(suction_pipe_length, given->suction_pipe_length,
       fmax(d1 / 3,
            1.2 * design->nut_length - design->outlet_width + (CW_MERIDIAN_HUB_START - 1) * design->axial_length),
       "D1 / 3, past the nut");
  value = CORRELATED(CW_CORRELATED_BASE_DIAMETER);
  TAKE(base_diameter, table->volute.base_diameter, value, source);
  value = CORRELATED(CW_CORRELATED_INLET_WIDTH);
  TAKE(inlet_width, table->volute.inlet_width, value, source);
  const int splitters = cw_case_given(given->splitter_start);
  SET(splitter_start, splitters ? given->splitter_start : 0, splitters ? "case" : "none");
  SET(splitter_position, given->splitter_position, "case or its default");
  SET(leading_edge_ratio, given->leading_edge_ratio, "case or its default");
  SET(thickest_at, given->thickest_at, "case or its default");
  SET(lean_angle, given->lean_angle, "case or its default");
  TAKE(wrap_angle, given->wrap_angle, 1.2 * 2 * M_PI / design->blade_count, "overlap 1.2");
  SET(wrap_spread, 0, "none");
  SET(interface_radius, (d2 + design->base_diameter) / 4, "(D2 + D3) / 4");
}

static const double EYE_SHARE = 0.05; // of the eye's height: least distance of the leading edge from the eye's plane

// The leading edge on the shroud: outside the eye at low specific speed, and drawn into it above nq = 25, where the
// wheel turns mixed-flow and the blades would else become too short.
static void leading_edge_shroud(const CwImpellerTable *given, CwDesign *design) {
  const double share = 0.635 - 0.105 * fmin(1, fmax(0, (design->specific_speed_nq - 25) / 35));
  TAKE(leading_edge_radius_shroud, given->leading_edge_radius_shroud, share * design->inlet_diameter,
       share < 0.635 ? "0.635 D1 to 0.53 D1 at nq 60" : "0.635 D1");
}

// A leading edge that is given at the eye's radius or inside it begins just behind the plane where the wall begins,
// which is parallel to the axis there.
static void keep_behind_eye(const CwMeridianCurve *wall, double height, const char *source, double *radius,
                            const char **radius_source) {
  double x[2], begin[2];
  double low = 0, high = 1;
  cw_meridian_point(wall, 0, begin, NULL);
  for (int i = 0; i < 50; i++) {
    const double middle = 0.5 * (low + high);
    cw_meridian_point(wall, middle, x, NULL);
    *(hypot(x[0] - begin[0], x[1] - begin[1]) < EYE_SHARE * height ? &low : &high) = middle;
  }
  cw_meridian_point(wall, high, x, NULL);
  if (*radius >= x[0]) return;
  *radius = x[0];
  *radius_source = source;
}

// On the hub: where a line square to the flow leads to from the shroud, but not so near to the axis that the blade
// would stand too steep there. The passage's height is that of the line.
static void leading_edge_hub(const CwImpellerTable *given, CwDesign *design) {
  CwMeridianCurve hub, shroud;
  cw_meridian_walls(design, design->hub_pole_radial, design->shroud_pole_axial, design->shroud_pole_radial, &hub,
                    &shroud);
  const double height = 0.5 * (design->inlet_diameter - design->hub_diameter);
  static const char *const at_eye = "at the eye: 0.05 of its height behind its plane";
  keep_behind_eye(&shroud, height, at_eye, &design->leading_edge_radius_shroud,
                  &design->source[CW_DESIGN_leading_edge_radius_shroud]);
  const CwPassageStation edge = cw_meridian_passage_at(&hub, &shroud, design->leading_edge_radius_shroud);
  TAKE(leading_edge_radius_hub, given->leading_edge_radius_hub,
       fmax(edge.hub[0], fmax(0.56 * design->hub_diameter, 0.55 * design->leading_edge_radius_shroud)),
       "square to the flow from the shroud's, at least 0.56 hub diameters and 0.55 of the shroud's");
  keep_behind_eye(&hub, height, at_eye, &design->leading_edge_radius_hub,
                  &design->source[CW_DESIGN_leading_edge_radius_hub]);
  SET(inlet_passage_width, edge.height, "square to the flow from the shroud's leading edge");
}

// The one blade angle that closes a wrap at mid-span (a logarithmic spiral): the integral is inverse to tan
// beta.
static double spiral_angle(const CwMeridian *meridian, double wrap) {
  const double beta[3] = {M_PI / 4, M_PI / 4, M_PI / 4};
  return atan(cw_blade_wrap(meridian, 0.5, beta) / wrap);
}

static void inlet_triangle(const CwCase *table, const CwMeridian *meridian, CwDesign *design) {
  double x[2];
  cw_meridian_blade_point(meridian, 0.5, 0, x, NULL);
  const double r = x[0], u = design->angular_speed * r, z = design->blade_count;
  const double cm = design->water_flow_rate / cw_meridian_area(meridian, 0), given = table->impeller.inlet_blade_angle;
  SET(inlet_blade_speed, u, "omega r at the mid-span leading edge");
  SET(inlet_meridional_speed, cm, "Q / area");
  // The flow with a little incidence, but within a nearly even law: the wrap leaves no more.
  // The flow angle with blockage needs the blade angle and that the flow angle: a few rounds.
  const int wrapped = design->priority == CW_PRIORITY_WRAP;
  const double spiral = wrapped ? spiral_angle(meridian, design->wrap_angle) : 0;
  const char *source, *incidence_source;
  const double usual = CORRELATED(CW_CORRELATED_INCIDENCE), asked = table->impeller.incidence;
  const double incidence = cw_case_given(asked) ? asked : usual;
  incidence_source = cw_case_given(asked) ? "flow angle + the case's incidence" : "flow angle + the family's incidence";
  source = incidence_source;
  // On the shroud, at a greater radius, the angle is less; 12 degrees are the least.
  const double least = fmax(13 * degree, atan(tan(12.05 * degree) * design->leading_edge_radius_shroud / r));
  double beta = cw_case_given(given) ? given : 25 * degree, tau = 1, flow = 0;
  for (int i = 0; i < 50; i++) {
    tau = cw_blockage(z, design->leading_edge_thickness, r, beta);
    flow = atan2(cm * tau, u);
    if (!cw_case_given(given)) beta = fmax(flow + incidence, least);
    if (!cw_case_given(given) && wrapped) beta = fmin(fmax(beta, spiral - 4 * degree), spiral + 2 * degree);
  }
  if (wrapped && beta == spiral - 4 * degree) source = "4 deg under the logarithmic spiral of the wrap";
  if (wrapped && beta == spiral + 2 * degree) source = "2 deg over the logarithmic spiral of the wrap";
  TAKE(inlet_blade_angle, given, beta, source);
  SET(inlet_blockage, tau, "1 / (1 - z e / (pi D sin beta1))");
  SET(inlet_flow_angle, flow, "atan(tau1 c_m1 / u1), no pre-swirl");
  SET(incidence, beta - flow, "beta1 - flow angle");
  SET(inlet_relative_speed, hypot(u, cm * tau), "inlet triangle");
}

// Wrap of the straight law beta1 to beta2 at mid-span.
static double straight_wrap(const CwMeridian *meridian, double beta1, double beta2) {
  const double beta[3] = {beta1, 0.5 * (beta1 + beta2), beta2};
  return cw_blade_wrap(meridian, 0.5, beta);
}

// Range of a computed beta2 where D2 is open, and so can meet the head instead.
static const double usual_beta[2] = {18 * M_PI / 180, 32 * M_PI / 180};

// Sets beta2 and the wrap by the priority. `fixed`: the outlet blade angle where D2 meets the head, or NAN.
static CwStatus outlet_angle(const CwCase *table, const CwMeridian *meridian, double fixed, CwDesign *design) {
  CwStatus status = CW_OK;
  const double given = table->impeller.outlet_blade_angle, beta1 = design->inlet_blade_angle;
  const double table_wrap = table->impeller.wrap_angle, least = 12 * degree, largest = 60 * degree;
  double low = least, high = largest;
  if (design->priority == CW_PRIORITY_BETA) {
    TAKE(outlet_blade_angle, given, 25 * degree, "25 deg: middle of the usual 18 to 32");
    SET(wrap_angle, straight_wrap(meridian, beta1, design->outlet_blade_angle), "straight law beta1 to beta2");
  } else if (design->priority == CW_PRIORITY_HEAD) {
    for (int i = 0; i < 60; i++) {
      design->outlet_blade_angle = 0.5 * (low + high);
      cw_outlet_triangle(meridian, design);
      if (design->predicted_head < design->head)
        low = design->outlet_blade_angle;
      else
        high = design->outlet_blade_angle;
    }
    SET(outlet_blade_angle, cw_case_given(fixed) ? fixed : 0.5 * (low + high),
        cw_case_given(fixed) ? "limit of the usual 18 to 32 deg; D2 meets the head" : "solved for the head");
    SET(wrap_angle, straight_wrap(meridian, beta1, design->outlet_blade_angle), "straight law beta1 to beta2");
  } else {
    for (int i = 0; i < 60; i++) {
      const double middle = 0.5 * (low + high);
      if (straight_wrap(meridian, beta1, middle) > design->wrap_angle)
        low = middle;
      else
        high = middle;
    }
    const double solved = 0.5 * (low + high);
    TAKE(outlet_blade_angle, given, solved, "straight law beta1 to beta2 closes the wrap");
    CW_REQUIRE(cw_case_given(given) || (solved > least + 1e-6 && solved < largest - 1e-6), CW_ERR_DESIGN,
               "a wrap of %.2f deg with beta1 = %.2f deg asks for an outlet blade angle outside 12 to 60 "
               "deg: change wrap_angle_deg, inlet_blade_angle_deg or the leading edge radii",
               design->wrap_angle / degree, beta1 / degree);
  }
  SET(wrap_residual, cw_case_given(table_wrap) ? design->wrap_angle - table_wrap : 0, "wrap - table's wrap");
  SET(outlet_angle_residual, cw_case_given(given) ? design->outlet_blade_angle - given : 0, "beta2 - table's beta2");
  SET(overlap, design->blade_count * design->wrap_angle / (2 * M_PI), "z wrap / 360 deg");
  cw_outlet_triangle(meridian, design);
done:
  return status;
}

// Everything up to the predicted head, with the given outlet diameter and outlet blade angle or NAN for each. The walls
// of the meridian are shaped anew where `shape` is set, and else keep their shares.
static CwStatus impeller(const CwCase *table, double outlet_diameter, double fixed, int shape, CwMeridian *meridian,
                         CwDesign *design) {
  CwStatus status = CW_OK;
  main_dimensions(table, outlet_diameter, design);
  CW_REQUIRE(
      design->blade_count * design->leading_edge_thickness < 0.7 * M_PI * design->inlet_diameter * sin(15 * degree) * 2,
      CW_ERR_DESIGN, "%d blades of %.2f mm at the leading edge fill the inlet of %.1f mm: fewer or thinner blades",
      design->blade_count, design->leading_edge_thickness * 1e3, design->inlet_diameter * 1e3);
  leading_edge_shroud(&table->impeller, design);
  if (shape) cw_meridian_shape(&table->impeller, design);
  leading_edge_hub(&table->impeller, design);
  CW_TRY(cw_meridian_make(design, meridian));
  inlet_triangle(table, meridian, design);
  CW_TRY(outlet_angle(table, meridian, fixed, design));
done:
  return status;
}

// Solves an open D2 for the head, from the correlation's value on, with the given outlet blade angle or NAN.
static CwStatus outlet_diameter_for_head(const CwCase *table, double fixed, CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  const double largest = largest_outlet_diameter(table), correlated = design->outlet_diameter;
  // Twice, since the walls are shaped for a diameter that then changes.
  for (int pass = 0; pass < 2; pass++) {
    double low = 0.7 * correlated, high = fmin(3 * correlated, largest);
    CW_TRY(impeller(table, design->outlet_diameter, fixed, 1, meridian, design));
    for (int i = 0; i < 50; i++) {
      const double middle = 0.5 * (low + high);
      CW_TRY(impeller(table, middle, fixed, 0, meridian, design));
      *(design->predicted_head < design->head ? &low : &high) = middle;
    }
  }
done:
  return status;
}

static int meets_head(const CwDesign *design) {
  return fabs(design->head_residual) < 1e-6 * design->head;
}

// A design by the head keeps the correlation's D2 where the outlet blade angle that it wants is a usual one. The
// largest D2 that a given D3 leaves may take a greater angle.
static CwStatus solve_outlet_diameter(const CwCase *table, CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  const double largest = largest_outlet_diameter(table);
  const int by_head = design->priority == CW_PRIORITY_HEAD;
  double fixed = NAN;
  CW_TRY(impeller(table, NAN, NAN, 1, meridian, design));
  if (by_head) {
    if (meets_head(design) && design->outlet_blade_angle >= usual_beta[0] &&
        design->outlet_blade_angle <= usual_beta[1])
      goto done;
    fixed = fmin(usual_beta[1], fmax(usual_beta[0], design->outlet_blade_angle));
  }
  CW_TRY(outlet_diameter_for_head(table, fixed, meridian, design));
  if (by_head && !meets_head(design) && design->outlet_diameter > (1 - 1e-9) * largest)
    CW_TRY(impeller(table, largest, NAN, 1, meridian, design));
  CW_REQUIRE(
      meets_head(design) || design->outlet_diameter < (1 - 1e-9) * largest, CW_ERR_DESIGN,
      "a head of %.3f m asks for a larger wheel than D2 = %.2f mm, the most that base_diameter_mm leaves (%.3f m "
      "with beta2 = %.2f deg): raise base_diameter_mm, or change outlet_width_mm or blade_count",
      design->head, largest * 1e3, design->predicted_head, design->outlet_blade_angle / degree);
  CW_REQUIRE(meets_head(design), CW_ERR_DESIGN,
             "no outlet diameter from 0.7 to 3 times the correlation's meets the head of %.3f m with beta2 "
             "= %.2f deg "
             "(%.3f m at D2 = %.1f mm): give outlet_diameter_mm, or change outlet_width_mm or blade_count",
             design->head, design->outlet_blade_angle / degree, design->predicted_head, design->outlet_diameter * 1e3);
done:
  return status;
}

// The least difference of the wraps at shroud and hub with which all sections have a law within the allowed
// angles and blades stand on hub and shroud at 70 degrees or more; where there is none, the one with the
// steepest blades.
static void choose_wrap_spread(const CwImpellerTable *given, const CwMeridian *meridian, CwDesign *design) {
  CwBladeSection section;
  const double step = 3 * degree, enough = 70 * degree;
  double best = -1, best_spread = 0;
  TAKE(wrap_spread, given->wrap_spread, 0, "none needed");
  if (cw_case_given(given->wrap_spread) || design->blade_form != CW_BLADE_TWISTED) return;
  for (int i = 0; i <= 40; i++) {
    double angle = 0;
    design->wrap_spread = (i % 2 ? 1 : -1) * ((i + 1) / 2) * step;
    int fits = 1;
    for (int j = 1; fits && j < 4; j++) fits = cw_blade_section(design, meridian, 0.25 * j, &section) == CW_OK;
    fits = fits && cw_blade_wall_angle(design, meridian, &angle) == CW_OK;
    cw_fail_clear();
    if (!fits || angle <= best) continue;
    best = angle;
    best_spread = design->wrap_spread;
    if (angle > enough) break;
  }
  SET(wrap_spread, best_spread,
      best_spread != 0 ? "angles within 12 to 60 deg, steep blades at the walls" : "none needed");
}

static CwPriority resolved_priority(const CwImpellerTable *given) {
  if (given->priority != CW_PRIORITY_AUTO) return given->priority;
  return cw_case_given(given->wrap_angle)           ? CW_PRIORITY_WRAP
         : cw_case_given(given->outlet_blade_angle) ? CW_PRIORITY_BETA
                                                    : CW_PRIORITY_HEAD;
}

static void passage(const CwMeridian *meridian, CwDesign *design) {
  enum { STEPS = 100 };
  double x[2], dx[2], length = 0;
  CwPassageStation station[STEPS + 1];
  cw_meridian_passage(&meridian->hub, &meridian->shroud, design->outlet_diameter / 2, STEPS + 1, station);
  for (int i = 0; i <= STEPS; i++) {
    cw_meridian_blade_point(meridian, 0.5, (double)i / STEPS, x, dx);
    length += hypot(dx[0], dx[1]) * (i == 0 || i == STEPS ? 0.5 : 1) / STEPS;
  }
  SET(meridional_length, length, "meridian");
  SET(passage_area_eye, station[0].area, "meridian");
  SET(passage_area_inlet, cw_meridian_area(meridian, 0), "meridian");
  SET(passage_area_outlet, cw_meridian_area(meridian, 1), "meridian");
  SET(passage_area_reversal, cw_passage_reversal(station, STEPS + 1), "against its trend from the eye to D2");
  SET(shroud_bend_radius, cw_meridian_bend_radius(&meridian->shroud), "meridian");
}

// What two root fillets facing one another take of a wall on which the blades stand at an angle.
static double fillet_width(double radius, double wall_angle) {
  return 2 * radius / sin(fmax(M_PI / 4, wall_angle));
}

// Between neighbours a quarter of the blade's thickness must be left of hub and shroud beside the root fillets.
static CwStatus check_clearance(const CwMeridian *meridian, const CwDesign *design) {
  CwStatus status = CW_OK;
  double clear, angle;
  CW_TRY(cw_blade_clearance(design, meridian, &clear));
  CW_TRY(cw_blade_wall_angle(design, meridian, &angle));
  const double least = 0.25 * design->blade_thickness, fillets = fillet_width(design->root_fillet_radius, angle);
  const char *splitters = design->splitter_start > 0 ? " and as many splitters" : "";
  CW_REQUIRE(clear > least, CW_ERR_DESIGN,
             "%d blades%s are %.2f mm apart on hub or shroud; at least %.2f mm are allowed (a quarter of the blade's "
             "thickness): lower blade_count, blade_thickness_mm or the wrap, or leave splitter_start out",
             design->blade_count, splitters, clear * 1e3, least * 1e3);
  CW_REQUIRE(clear > least + fillets, CW_ERR_DESIGN,
             "%d blades%s are %.2f mm apart on hub or shroud, of which root fillets take %.2f mm; at least %.2f mm "
             "must be left: lower root_fillet_radius_mm to %.2f, or lower blade_count, or leave splitter_start out",
             design->blade_count, splitters, clear * 1e3, fillets * 1e3, least * 1e3,
             floor(1e5 * design->root_fillet_radius * (clear - least) / fillets) / 1e2);
done:
  return status;
}

CwStatus cw_hydraulic_design(const CwCase *table, CwDesign *design) {
  CwStatus status = CW_OK;
  CwMeridian meridian;
  *design = (CwDesign){.priority = resolved_priority(&table->impeller),
                       .correlations = table->design.correlations,
                       .slip = table->design.slip,
                       .rotation = table->impeller.rotation,
                       .blade_form = table->impeller.blade_form,
                       .trailing_edge = table->impeller.trailing_edge,
                       .warn_share = table->design.warn_share,
                       .density = table->fluid.density};
  SET(flow_rate, table->operating_point.flow_rate, "case");
  SET(head, table->operating_point.head, "case");
  SET(angular_speed, table->operating_point.speed, "case");
  const double vapour = table->fluid.vapour_pressure;
  SET(vapour_pressure, cw_case_given(vapour) ? vapour : cw_water_vapour_pressure(20), "case, or that of water (IAPWS)");
  water_duty(table, design);
  specific_speeds(table, design);
  if (cw_case_given(table->impeller.outlet_diameter))
    CW_TRY(impeller(table, NAN, NAN, 1, &meridian, design));
  else
    CW_TRY(solve_outlet_diameter(table, &meridian, design));
  CW_REQUIRE(design->priority != CW_PRIORITY_HEAD || fabs(design->head_residual) < 1e-3 * design->head, CW_ERR_DESIGN,
             "a head of %.3f m asks for an outlet blade angle outside 12 to 60 deg (head %.3f m at the nearest): "
             "change outlet_diameter_mm, outlet_width_mm or the priority",
             design->head, design->predicted_head);
  choose_wrap_spread(&table->impeller, &meridian, design);
  CW_TRY(check_clearance(&meridian, design));
  passage(&meridian, design);
  CW_TRY(cw_velocity_triangles(&meridian, table->operating_point.inlet_pressure, design));
  TAKE(trailing_edge_bevel, table->impeller.trailing_edge_bevel,
       cw_blade_usual_bevel(design->trailing_edge, design->trailing_edge_thickness, design->outlet_blade_angle),
       design->trailing_edge == CW_EDGE_SHARP ? "leg along the blade twice the cut"
                                              : "as long as the rest of the trailing edge");
  CW_TRY(cw_design_volute(&table->volute, design));
  const double r2 = design->outlet_diameter / 2, r3 = design->base_diameter / 2;
  SET(relative_speed, 0.5 * (design->inlet_relative_speed + design->outlet_relative_speed), "(w1 + w2) / 2");
  SET(volute_speed, 0.5 * (design->outlet_swirl_speed * r2 / r3 + design->throat_speed),
      "mean of K / r3 and the throat's speed");
  SET(suction_speed, design->flow_rate / (M_PI / 4 * pow(design->inlet_diameter, 2)), "Q / (pi D1^2 / 4)");
  SET(discharge_speed, design->flow_rate / (M_PI / 4 * pow(design->discharge_diameter, 2)), "Q / (pi DN^2 / 4)");
done:
  return status;
}
