// SPDX-License-Identifier: AGPL-3.0-or-later
// Correlations: Gulich, Centrifugal Pumps; Guan, Modern Pumps Theory and Design; Wiesner 1967 in Gulich's
// form.
#include "geometry/hydraulic_design.h"

#include <math.h>
#include <stdio.h>

#include "geometry/blade.h"
#include "geometry/meridian.h"
#include "geometry/volute_section.h"

static const double gravity = 9.80665;
static const double degree = M_PI / 180;

// Takes the case's value where it is given, else the computed one, and notes which.
#define TAKE(member, given, computed, text)                                                                  \
  do {                                                                                                       \
    const double take_given = (given);                                                                       \
    design->member = cw_case_given(take_given) ? take_given : (computed);                                    \
    design->source[CW_DESIGN_##member] = cw_case_given(take_given) ? "case" : (text);                        \
  } while (0)
#define SET(member, value, text)                                                                             \
  do {                                                                                                       \
    design->member = (value);                                                                                \
    design->source[CW_DESIGN_##member] = (text);                                                             \
  } while (0)

// Smallest of the standard bores whose mean speed stays under 4 m/s and that is wider than `least`, m.
static double standard_bore(double flow_rate, double least) {
  static const double bore[] = {0.015, 0.020, 0.025, 0.032, 0.040, 0.050, 0.065, 0.080, 0.100, 0.125,
                                0.150, 0.200, 0.250, 0.300, 0.350, 0.400, 0.500, 0.600, 0.800, 1.000};
  const size_t count = sizeof bore / sizeof *bore;
  for (size_t i = 0; i < count; i++)
    if (flow_rate / (M_PI / 4 * bore[i] * bore[i]) < 4 && bore[i] > least)
      return bore[i];
  return bore[count - 1];
}

static void main_dimensions(const CwCase *table, CwDesign *design) {
  const CwImpellerTable *given = &table->impeller;
  const double q = design->flow_rate, h = design->head, omega = design->angular_speed;
  const double rpm = omega * 30 / M_PI, guan_size = cbrt(q / rpm);
  SET(specific_speed_nq, rpm * sqrt(q) / pow(h, 0.75), "n Q^0.5 / H^0.75, rpm, m3/s, m");
  const double nq = design->specific_speed_nq;
  SET(specific_speed_ns, 3.65 * nq, "3.65 nq");
  const double psi = 1.21 * exp(-0.77 * nq / 100);
  TAKE(outlet_diameter, given->outlet_diameter, 2 / omega * sqrt(2 * gravity * h / psi),
       "Gulich: psi = 1.21 exp(-0.77 nq/100)");
  const double d2 = design->outlet_diameter;
  TAKE(outlet_width, given->outlet_width, 0.64 * pow(design->specific_speed_ns / 100, 5.0 / 6) * guan_size,
       "Guan: 0.64 (ns/100)^(5/6) (Q/n)^(1/3)");
  TAKE(hub_diameter, given->hub_diameter, 0.12 * d2, "stiffness: 0.12 D2");
  SET(impeller_tip_speed, omega * d2 / 2, "omega D2 / 2");
  SET(head_coefficient, 2 * gravity * h / pow(design->impeller_tip_speed, 2), "2 g H / u2^2");
  const double hub_ratio = design->hub_diameter / d2;
  TAKE(inlet_diameter, given->inlet_diameter,
       d2 * 1.16 * sqrt(hub_ratio * hub_ratio + 1.5e-3 * design->head_coefficient * pow(nq, 1.33)),
       "Gulich: d1* = 1.16 (dn*^2 + 1.5e-3 psi nq^1.33)^0.5");
  SET(nut_disk_radius, 0.145 * design->hub_diameter, "0.145 hub diameter");
  SET(nut_length, 7.0 / 12 * design->hub_diameter, "7/12 hub diameter");
  SET(axial_length, (d2 - design->inlet_diameter) * pow(nq / 74, 1.07), "Gulich: (D2 - D1) (nq/74)^1.07");
  const double d1 = design->inlet_diameter;
  TAKE(leading_edge_radius_hub, given->leading_edge_radius_hub, 0.568 * d1, "0.568 D1");
  TAKE(leading_edge_radius_shroud, given->leading_edge_radius_shroud, 0.635 * d1, "0.635 D1");
  TAKE(blade_thickness, given->blade_thickness, 0.020 * d2, "Gulich: 0.016 to 0.022 D2");
  TAKE(leading_edge_thickness, given->leading_edge_thickness, 0.70 * design->blade_thickness,
       "0.70 of the largest");
  TAKE(trailing_edge_thickness, given->trailing_edge_thickness, 0.50 * design->blade_thickness,
       "0.50 of the largest");
  TAKE(suction_pipe_length, given->suction_pipe_length, d1 / 3, "D1 / 3");
  TAKE(base_diameter, table->volute.base_diameter, 1.02 * d2, "1.02 D2");
  TAKE(inlet_width, table->volute.inlet_width, 1.5 * design->outlet_width, "1.5 b2");
  TAKE(wrap_angle, given->wrap_angle, 1.2 * 2 * M_PI / design->blade_count, "overlap 1.2");
  SET(interface_radius, (d2 + design->base_diameter) / 4, "(D2 + D3) / 4");
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
  const double cm = design->flow_rate / cw_meridian_area(meridian, 0),
               given = table->impeller.inlet_blade_angle;
  SET(inlet_blade_speed, u, "omega r at the mid-span leading edge");
  SET(inlet_meridional_speed, cm, "Q / area");
  // The flow with a little incidence, but within a nearly even law: the wrap leaves no more.
  // The flow angle with blockage needs the blade angle and that the flow angle: a few rounds.
  const int wrapped = table->impeller.priority == CW_PRIORITY_WRAP;
  const double spiral = wrapped ? spiral_angle(meridian, design->wrap_angle) : 0;
  const char *source = "flow angle + 4 deg";
  double beta = cw_case_given(given) ? given : 25 * degree, tau = 1, flow = 0;
  for (int i = 0; i < 50; i++) {
    tau = 1 / (1 - z * design->leading_edge_thickness / (2 * M_PI * r * sin(beta)));
    flow = atan2(cm * tau, u);
    if (!cw_case_given(given))
      beta = flow + 4 * degree;
    if (!cw_case_given(given) && wrapped)
      beta = fmin(fmax(beta, spiral - 4 * degree), spiral + 2 * degree);
  }
  if (wrapped && beta == spiral - 4 * degree)
    source = "4 deg under the logarithmic spiral of the wrap";
  if (wrapped && beta == spiral + 2 * degree)
    source = "2 deg over the logarithmic spiral of the wrap";
  TAKE(inlet_blade_angle, given, beta, source);
  SET(inlet_blockage, tau, "1 / (1 - z e / (pi D sin beta1))");
  SET(inlet_flow_angle, flow, "atan(tau1 c_m1 / u1), no pre-swirl");
  SET(incidence, beta - flow, "beta1 - flow angle");
  SET(inlet_relative_speed, hypot(u, cm * tau), "inlet triangle");
}

// Outlet triangle and head for the outlet blade angle of the design.
static void outlet_triangle(CwDesign *design) {
  const double beta = design->outlet_blade_angle, z = design->blade_count, d2 = design->outlet_diameter;
  const double u2 = design->impeller_tip_speed, limit = exp(-8.16 * sin(beta) / z);
  const double ratio = (design->leading_edge_radius_hub + design->leading_edge_radius_shroud) / d2;
  const double excess = fmax(0, (ratio - limit) / (1 - limit)), kw = 1 - excess * excess * excess;
  SET(slip_factor, 0.98 * (1 - sqrt(sin(beta)) / pow(z, 0.7)) * kw, "Wiesner in Gulich's form, f1 = 0.98");
  SET(outlet_meridional_speed, design->flow_rate / (M_PI * d2 * design->outlet_width), "Q / (pi D2 b2)");
  SET(outlet_blockage, 1 / (1 - z * design->trailing_edge_thickness / (M_PI * d2 * sin(beta))),
      "1 / (1 - z e / (pi D2 sin beta2))");
  const double cm = design->outlet_meridional_speed;
  const double cu = design->slip_factor * u2 - cm * design->outlet_blockage / tan(beta);
  SET(outlet_swirl_speed, cu, "gamma u2 - tau2 c_m2 / tan beta2");
  SET(outlet_absolute_speed, hypot(cu, cm), "outlet triangle");
  SET(outlet_relative_speed, hypot(u2 - cu, cm), "outlet triangle");
  SET(outlet_flow_angle, atan2(cm, u2 - cu), "outlet triangle");
  SET(outlet_absolute_angle, atan2(cm, cu), "outlet triangle");
  SET(diffusion_ratio, design->outlet_relative_speed / design->inlet_relative_speed, "w2 / w1");
  SET(hydraulic_efficiency, 1 + 0.0835 * log10(cbrt(design->flow_rate / (design->angular_speed * 30 / M_PI))),
      "Guan: 1 + 0.0835 lg (Q/n)^(1/3)");
  SET(theoretical_head, u2 * cu / gravity, "Euler: u2 c_u2 / g");
  SET(predicted_head, design->hydraulic_efficiency * design->theoretical_head, "eta_h u2 c_u2 / g");
  SET(head_residual, design->predicted_head - design->head, "predicted - asked");
}

// Wrap of the straight law beta1 to beta2 at mid-span.
static double straight_wrap(const CwMeridian *meridian, double beta1, double beta2) {
  const double beta[3] = {beta1, 0.5 * (beta1 + beta2), beta2};
  return cw_blade_wrap(meridian, 0.5, beta);
}

static CwStatus outlet_angle(const CwCase *table, const CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  const double given = table->impeller.outlet_blade_angle, beta1 = design->inlet_blade_angle;
  const double table_wrap = table->impeller.wrap_angle, least = 12 * degree, largest = 60 * degree;
  double low = least, high = largest;
  if (table->impeller.priority == CW_PRIORITY_BETA) {
    TAKE(outlet_blade_angle, given, 25 * degree, "25 deg: middle of the usual 18 to 32");
    SET(wrap_angle, straight_wrap(meridian, beta1, design->outlet_blade_angle),
        "straight law beta1 to beta2");
  } else if (table->impeller.priority == CW_PRIORITY_HEAD) {
    for (int i = 0; i < 60; i++) {
      design->outlet_blade_angle = 0.5 * (low + high);
      outlet_triangle(design);
      if (design->predicted_head < design->head)
        low = design->outlet_blade_angle;
      else
        high = design->outlet_blade_angle;
    }
    CW_REQUIRE(
        fabs(design->head_residual) < 1e-3 * design->head, CW_ERR_DESIGN,
        "a head of %.3f m asks for an outlet blade angle outside 12 to 60 deg (head %.3f m at the nearest): "
        "change D2, b2 or the priority",
        design->head, design->predicted_head);
    SET(outlet_blade_angle, 0.5 * (low + high), "solved for the head");
    SET(wrap_angle, straight_wrap(meridian, beta1, design->outlet_blade_angle),
        "straight law beta1 to beta2");
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
               "deg: change "
               "the wrap, beta1 or the leading edge radii",
               design->wrap_angle / degree, beta1 / degree);
  }
  SET(wrap_residual, cw_case_given(table_wrap) ? design->wrap_angle - table_wrap : 0, "wrap - table's wrap");
  SET(overlap, design->blade_count * design->wrap_angle / (2 * M_PI), "z wrap / 360 deg");
  outlet_triangle(design);
done:
  return status;
}

static CwStatus volute(const CwVoluteTable *given, CwDesign *design) {
  CwStatus status = CW_OK;
  const double r2 = design->outlet_diameter / 2, r3 = design->base_diameter / 2;
  SET(swirl_constant, design->outlet_swirl_speed * r2, "c_u2 r2");
  const int rectangle = given->section == CW_SECTION_RECTANGLE;
  if (rectangle)
    SET(side_wall_angle, 0, "rectangle");
  else
    TAKE(side_wall_angle, given->side_wall_angle, 20 * degree, "20 deg: full angle 40, usual 30 to 45");
  // Stepanoff's chart of K3 over specific speed: about 0.48 at nq 10, 0.42 at 20, 0.36 at 40.
  const double factor = cw_case_given(given->velocity_factor)
                            ? given->velocity_factor
                            : 0.42 * pow(design->specific_speed_nq / 20, -0.2);
  SET(section_speed, factor * sqrt(2 * gravity * design->head),
      cw_case_given(given->velocity_factor) ? "case: K3" : "Stepanoff: K3 = 0.42 (nq / 20)^-0.2");
  // A plain trapezoid is near enough to see how wide the throat will be.
  const int velocity = given->area_law == CW_AREA_LAW_VELOCITY;
  const double b3 = design->inlet_width, slope = tan(design->side_wall_angle);
  const double spiral = cw_volute_trapezoid_height(r3, b3, design->side_wall_angle,
                                                   design->flow_rate / design->swirl_constant);
  const double area = velocity ? design->flow_rate / design->section_speed : spiral * (b3 + spiral * slope);
  const double height = 2 * area / (b3 + sqrt(b3 * b3 + 4 * slope * area));
  TAKE(corner_radius, given->corner_radius, rectangle ? fmin(b3, height) / 6 : 0,
       rectangle ? "a sixth of b3 or of the throat's height" : "one arc");
  TAKE(tongue_radius, given->tongue_radius, fmin(0.0075 * design->outlet_diameter, height / 6),
       "0.0075 D2: casting; at most a sixth of the throat");
  TAKE(discharge_diameter, given->outlet_diameter,
       cw_case_given(given->diffuser_area_ratio)
           ? sqrt(given->diffuser_area_ratio * 4 * area / M_PI)
           : standard_bore(design->flow_rate, 1.1 * sqrt(4 * area / M_PI)),
       "standard bore under 4 m/s, wider than the throat");
  TAKE(discharge_pipe_length, given->discharge_pipe_length, 2 * design->discharge_diameter, "2 DN");
  // Gulich's least distance of the tongue: d_z/D2 = 1.03 + 0.1 nq/40 + 0.07 rho H/(1000 kg/m3 1000 m).
  const double gap = r2 * (1.03 + 0.1 * design->specific_speed_nq / 40 + 0.07 * design->head / 1000) - r3;
  const CwVoluteInput input = {
      .flow_rate = design->flow_rate,
      .area_law = given->area_law,
      .angular_momentum = design->swirl_constant,
      .section_speed = design->section_speed,
      .section = given->section,
      .corner_radius = design->corner_radius > 0 ? design->corner_radius : NAN,
      .interface_radius = design->interface_radius,
      .neck_width = design->outlet_width,
      .base_diameter = design->base_diameter,
      .inlet_width = design->inlet_width,
      .side_wall_angle = design->side_wall_angle,
      .throat_area = given->throat_area,
      .tongue_radius = design->tongue_radius,
      .tongue_gap = given->tongue_gap,
      .tongue_angle = given->tongue_angle,
      .least_tongue_gap =
          cw_case_given(given->tongue_gap) || cw_case_given(given->tongue_angle) || gap < 0 ? NAN : gap,
      .diffuser_length = given->diffuser_length,
      .diffuser_angle = cw_case_given(given->diffuser_angle) ? given->diffuser_angle : 9 * degree,
      .outlet_diameter = cw_case_given(given->diffuser_area_ratio) ? NAN : design->discharge_diameter,
      .diffuser_area_ratio = given->diffuser_area_ratio,
      .discharge = given->discharge,
      .discharge_pipe_length = design->discharge_pipe_length,
  };
  CW_TRY(cw_volute_design(&input, &design->volute));
  TAKE(throat_area, given->throat_area, design->volute.throat_area,
       velocity ? "constant velocity" : "constant angular momentum K");
  SET(throat_speed, design->flow_rate / design->throat_area, "Q / throat area");
  SET(tongue_tip_radius, design->volute.tip_radius,
      cw_case_given(given->tongue_gap)
          ? "case: D3/2 + tongue gap"
          : "well shaped, at least Gulich's r2 (1.03 + 0.1 nq/40 + 0.07 H/1000 m)");
  SET(tongue_angle, design->volute.tip_angle,
      cw_case_given(given->tongue_angle) ? "case" : "where its gap asks for it");
  if (cw_case_given(given->diffuser_area_ratio))
    SET(discharge_diameter, design->volute.input.outlet_diameter, "area ratio of the diffuser");
  TAKE(diffuser_length, given->diffuser_length, design->volute.diffuser_length,
       cw_case_given(given->diffuser_angle) ? "full angle of the case" : "full angle 9 deg");
  SET(diffuser_area_ratio, design->volute.diffuser_area_ratio,
      cw_case_given(given->diffuser_area_ratio) ? "case" : "outlet over throat");
  SET(diffuser_angle, design->volute.diffuser_angle, "cone of equal areas");
done:
  return status;
}

CwStatus cw_hydraulic_design(const CwCase *table, CwDesign *design) {
  CwStatus status = CW_OK;
  CwMeridian meridian;
  *design = (CwDesign){.blade_count = table->impeller.blade_count, .priority = table->impeller.priority};
  SET(flow_rate, table->operating_point.flow_rate, "case");
  SET(head, table->operating_point.head, "case");
  SET(angular_speed, table->operating_point.speed, "case");
  main_dimensions(table, design);
  CW_TRY(cw_meridian_make(design, &meridian));
  inlet_triangle(table, &meridian, design);
  CW_TRY(outlet_angle(table, &meridian, design));
  TAKE(trailing_edge_bevel, table->impeller.trailing_edge_bevel,
       cw_blade_balanced_bevel(design->trailing_edge_thickness, design->outlet_blade_angle),
       "as long as the rest of the trailing edge");
  CW_TRY(volute(&table->volute, design));
  const double r2 = design->outlet_diameter / 2, r3 = design->base_diameter / 2;
  SET(relative_speed, 0.5 * (design->inlet_relative_speed + design->outlet_relative_speed), "(w1 + w2) / 2");
  SET(volute_speed, 0.5 * (design->outlet_swirl_speed * r2 / r3 + design->throat_speed),
      "mean of K / r3 and the throat's speed");
  SET(suction_speed, design->flow_rate / (M_PI / 4 * pow(design->inlet_diameter, 2)), "Q / (pi D1^2 / 4)");
  SET(discharge_speed, design->flow_rate / (M_PI / 4 * pow(design->discharge_diameter, 2)),
      "Q / (pi DN^2 / 4)");
done:
  return status;
}

// How each kind of quantity is printed.
enum { NUMBER, LENGTH, HEAD, ANGLE, SPEED, FLOW, ANGULAR_SPEED, AREA, DIFFUSIVITY };
static const struct {
  double scale;
  const char *unit;
} print_unit[] = {
    [NUMBER] = {1, ""},
    [LENGTH] = {1e3, "mm"},
    [HEAD] = {1, "m"},
    [ANGLE] = {180 / M_PI, "deg"},
    [SPEED] = {1, "m/s"},
    [FLOW] = {3600, "m3/h"},
    [ANGULAR_SPEED] = {30 / M_PI, "rpm"},
    [AREA] = {1e6, "mm2"},
    [DIFFUSIVITY] = {1, "m2/s"},
};

void cw_hydraulic_design_row(const CwDesign *design, CwDesignQuantity quantity, char *line, size_t size) {
  switch (quantity) {
#define ROW(member, kind, text)                                                                              \
  case CW_DESIGN_##member:                                                                                   \
    snprintf(line, size, "%-52s %10.5g %-5s %s", text, design->member *print_unit[kind].scale,               \
             print_unit[kind].unit, design->source[quantity]);                                               \
    break;
    CW_DESIGN_LIST(ROW)
#undef ROW
  default:
    snprintf(line, size, "?");
  }
}
