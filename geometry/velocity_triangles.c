// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/velocity_triangles.h"

#include <math.h>
#include <stdio.h>

#include "geometry/blade.h"
#include "geometry/correlations.h"
#include "geometry/design_source.h"
#include "geometry/root.h"

const double cw_allowed_beta[2] = {12 * CW_DEGREE, 60 * CW_DEGREE};

double cw_blockage(double count, double thickness, double radius, double angle) {
  return 1 / (1 - count * thickness / (2 * M_PI * radius * sin(angle)));
}

// The one blade angle that closes a wrap at mid-span (a logarithmic spiral): the integral is inverse to tan
// beta.
static double spiral_angle(const CwMeridian *meridian, double wrap) {
  const double beta[3] = {M_PI / 4, M_PI / 4, M_PI / 4};
  return atan(cw_blade_wrap(meridian, 0.5, beta) / wrap);
}

static const double SAME_ANGLE = 0.1 * M_PI / 180; // an incidence that is off by less is met

// The inlet at mid-span, whose blades fill the share `filled` / sin beta of the circumference.
typedef struct {
  double meridional, blade; // c_m1 before the blades, u1
  double filled;            // z e / (2 pi r)
  double incidence;         // wanted
} Inlet;

// Between blades of the angle beta; 90 degrees and more where they fill the inlet.
static double flow_angle(const Inlet *inlet, double beta) {
  return atan2(inlet->meridional, inlet->blade * (1 - inlet->filled / sin(beta)));
}

// Grows with beta, since steeper blades leave the flow more room: it has one root.
static double incidence_excess(double beta, const void *context) {
  const Inlet *inlet = context;
  return beta - flow_angle(inlet, beta) - inlet->incidence;
}

// The blade angle that meets the flow with the wanted incidence, or the end of the range that is nearer to it.
static double met_angle(const Inlet *inlet, double low, double high) {
  if (incidence_excess(low, inlet) >= 0) return low;
  return incidence_excess(high, inlet) <= 0 ? high : cw_root_find(incidence_excess, inlet, low, high);
}

static Inlet inlet_of(const CwCase *table, const CwDesign *design, const char **source) {
  const double usual = cw_correlation(design->correlations, CW_CORRELATED_INCIDENCE, design, source);
  const double asked = table->impeller.incidence, r = design->inlet_blade_speed / design->angular_speed;
  *source = cw_case_given(asked) ? "flow angle + the case's incidence" : "flow angle + the family's incidence";
  return (Inlet){.meridional = design->inlet_meridional_speed,
                 .blade = design->inlet_blade_speed,
                 .filled = design->blade_count * design->leading_edge_thickness / (2 * M_PI * r),
                 .incidence = cw_case_given(asked) ? asked : usual};
}

void cw_inlet_triangle(const CwCase *table, const CwMeridian *meridian, CwDesign *design) {
  double x[2];
  cw_meridian_blade_point(meridian, 0.5, 0, x, NULL);
  const double r = x[0], cm = design->water_flow_rate / cw_meridian_area(meridian, 0);
  const double given = table->impeller.inlet_blade_angle, asked = table->impeller.incidence;
  SET(inlet_blade_speed, design->angular_speed * r, "omega r at the mid-span leading edge");
  SET(inlet_meridional_speed, cm, "Q / area");
  const char *source;
  const Inlet inlet = inlet_of(table, design, &source);
  // The flow with a little incidence, but within a nearly even law: the wrap leaves no more.
  // On the shroud, at a greater radius, the angle is less; 12 degrees are the least.
  const int wrapped = design->priority == CW_PRIORITY_WRAP;
  double low = fmax(13 * CW_DEGREE, atan(tan(12.05 * CW_DEGREE) * design->leading_edge_radius_shroud / r));
  double high = fmax(low, cw_allowed_beta[1]);
  if (wrapped) {
    const double spiral = spiral_angle(meridian, design->wrap_angle);
    high = spiral + 2 * CW_DEGREE;
    low = fmin(high, fmax(low, spiral - 4 * CW_DEGREE));
    if (incidence_excess(low, &inlet) >= 0 && low == spiral - 4 * CW_DEGREE)
      source = "4 deg under the logarithmic spiral of the wrap";
    if (incidence_excess(high, &inlet) <= 0) source = "2 deg over the logarithmic spiral of the wrap";
  }
  TAKE(inlet_blade_angle, given, met_angle(&inlet, low, high), source);
  const double beta = design->inlet_blade_angle, flow = flow_angle(&inlet, beta);
  SET(inlet_blockage, cw_blockage(design->blade_count, design->leading_edge_thickness, r, beta),
      "1 / (1 - z e / (pi D sin beta1))");
  SET(inlet_flow_angle, flow, "atan(tau1 c_m1 / u1), no pre-swirl");
  SET(incidence, beta - flow, "beta1 - flow angle");
  if (fabs(design->incidence - asked) > SAME_ANGLE) // not where it is left out
    GIVE_WAY(incidence, beta - flow, asked,
             cw_case_given(given) ? "incidence_deg gives way to inlet_blade_angle_deg"
                                  : "incidence_deg gives way to blade angles of 12 deg and more, or to the wrap");
  SET(inlet_relative_speed, hypot(inlet.blade, cm * design->inlet_blockage), "inlet triangle");
}

// Where the inlet is open between blades of beta1 at mid-span and on the hub, over the circumference at mid-span.
static double least_opening(const CwDesign *design) {
  const double beta = design->inlet_blade_angle, r = design->inlet_blade_speed / design->angular_speed;
  const double hub = design->leading_edge_radius_hub / r;
  return fmin(sin(beta), hub * sin(atan(tan(beta) / hub)));
}

CwStatus cw_inlet_check(const CwCase *table, const CwDesign *design) {
  CwStatus status = CW_OK;
  const char *source;
  const Inlet inlet = inlet_of(table, design, &source);
  const double beta = design->inlet_blade_angle, incidence = inlet.incidence;
  const int open = !cw_case_given(table->impeller.inlet_blade_angle) && design->priority != CW_PRIORITY_WRAP;
  const int steep = open && incidence_excess(beta, &inlet) < -1e-9; // at the end of the range
  // What the flow needs of the circumference to come at beta1 less the incidence.
  const double need = steep ? inlet.meridional / (inlet.blade * tan(beta - incidence)) : 0;
  const double most = fmin(least_opening(design), (1 - need) * sin(beta)), share = most / inlet.filled;
  const double fewer = floor((1 - 1e-9) * share * design->blade_count);
  char count[60] = "";
  CW_REQUIRE(need < 1, CW_ERR_DESIGN,
             "the flow comes to the blades at %.1f deg without their blockage; with an incidence of %.1f deg blades "
             "have at most %.0f deg: raise inlet_diameter_mm, or lower incidence_deg",
             atan2(inlet.meridional, inlet.blade) / CW_DEGREE, incidence / CW_DEGREE, beta / CW_DEGREE);
  if (fewer >= 2) snprintf(count, sizeof count, ", or lower blade_count to at most %.0f", fewer);
  CW_REQUIRE(
      share > 1, CW_ERR_DESIGN,
      "%d blades of leading_edge_thickness_mm %.4g with beta1 = %.2f deg leave the flow too little of the inlet: "
      "lower leading_edge_thickness_mm to less than %.4g%s",
      design->blade_count, 1e3 * design->leading_edge_thickness, beta / CW_DEGREE,
      1e3 * share * design->leading_edge_thickness, count);
done:
  return status;
}

// Slip factor gamma by Wiesner in Guelich's form, for `count` blades, beta2 and the ratio of mean inlet to
// outlet diameter: 0.98 (1 - sin(beta2)^0.5 / z^0.7) kw.
static double slip_wiesner(double count, double outlet_angle, double diameter_ratio) {
  const double limit = exp(-8.16 * sin(outlet_angle) / count);
  const double excess = fmax(0, (diameter_ratio - limit) / (1 - limit)), kw = 1 - excess * excess * excess;
  return 0.98 * (1 - sqrt(sin(outlet_angle)) / pow(count, 0.7)) * kw;
}

double cw_slip_pfleiderer(double count, double outlet_angle, double outlet_radius, double static_moment) {
  return 0.65 * (1 + outlet_angle / (60 * CW_DEGREE)) * outlet_radius * outlet_radius / (count * static_moment);
}

// Integral of r dm along the blade at mid-span, m2.
static double static_moment(const CwMeridian *meridian) {
  enum { STEPS = 100 }; // Simpson
  double sum = 0;
  for (int i = 0; i <= STEPS; i++) {
    double x[2], dx[2];
    cw_meridian_blade_point(meridian, 0.5, (double)i / STEPS, x, dx);
    sum += x[0] * hypot(dx[0], dx[1]) * (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2);
  }
  return sum / (3 * STEPS);
}

static double outlet_blades(const CwDesign *design) {
  return design->blade_count * (design->splitter_start > 0 ? 2 : 1);
}

double cw_slip_blades(const CwDesign *design) {
  return design->blade_count * (design->splitter_start > 0 ? 2 - design->splitter_start : 1);
}

void cw_outlet_triangle(const CwMeridian *meridian, CwDesign *design) {
  const double beta = design->outlet_blade_angle, d2 = design->outlet_diameter, u2 = design->impeller_tip_speed;
  const double ratio = (design->leading_edge_radius_hub + design->leading_edge_radius_shroud) / d2;
  const double blades = cw_slip_blades(design);
  SET(outlet_meridional_speed, design->water_flow_rate / (M_PI * d2 * design->outlet_width), "Q / (pi D2 b2)");
  SET(outlet_blockage, cw_blockage(outlet_blades(design), design->trailing_edge_thickness, d2 / 2, beta),
      "1 / (1 - z e / (pi D2 sin beta2))");
  const double cm = design->outlet_meridional_speed, turned = cm * design->outlet_blockage / tan(beta);
  SET(slip_factor_wiesner, slip_wiesner(blades, beta, ratio), "0.98 (1 - sin(beta2)^0.5 / z^0.7) kw: Guelich's form");
  const double p = cw_slip_pfleiderer(blades, beta, d2 / 2, static_moment(meridian));
  SET(slip_factor_pfleiderer, ((u2 - turned) / (1 + p) + turned) / u2,
      "p = 0.65 (1 + beta2/60 deg) r2^2 / (z S), S = integral r dm");
  const int pfleiderer = design->slip == CW_SLIP_PFLEIDERER;
  SET(slip_factor, pfleiderer ? design->slip_factor_pfleiderer : design->slip_factor_wiesner,
      pfleiderer ? "Pfleiderer" : "Wiesner");
  const double cu = design->slip_factor * u2 - turned;
  SET(outlet_swirl_speed, cu, "gamma u2 - tau2 c_m2 / tan beta2");
  SET(outlet_absolute_speed, hypot(cu, cm), "outlet triangle");
  SET(outlet_relative_speed, hypot(u2 - cu, cm), "outlet triangle");
  SET(outlet_flow_angle, atan2(cm, u2 - cu), "outlet triangle");
  SET(outlet_absolute_angle, atan2(cm, cu), "outlet triangle");
  SET(diffusion_ratio, design->outlet_relative_speed / design->inlet_relative_speed, "w2 / w1");
  const double euler = design->viscous_head_factor * design->hydraulic_efficiency * u2 / CW_GRAVITY;
  SET(theoretical_head, u2 * cu / CW_GRAVITY, "Euler: u2 c_u2 / g");
  SET(predicted_head, euler * cu, "C_H eta_h u2 c_u2 / g");
  SET(predicted_head_wiesner, euler * (design->slip_factor_wiesner * u2 - turned), "C_H eta_h u2 c_u2 / g");
  SET(predicted_head_pfleiderer, euler * (design->slip_factor_pfleiderer * u2 - turned), "C_H eta_h u2 c_u2 / g");
  SET(head_residual, design->predicted_head - design->head, "predicted - asked");
}

// Predicted head with an outlet blade angle; none where the blades fill the outlet.
static double head_at(const CwMeridian *meridian, double angle, CwDesign *design) {
  design->outlet_blade_angle = angle;
  cw_outlet_triangle(meridian, design);
  return design->outlet_blockage > 0 ? design->predicted_head : -HUGE_VAL;
}

// The angle from a to b at which the head passes the asked one, upwards or downwards. The whole range is bisected, so
// that the digits do not depend on a and b.
static double crossing(const CwMeridian *meridian, const double range[2], double a, double b, int upwards,
                       CwDesign *design) {
  double low = range[0], high = range[1];
  for (int i = 0; i < 60; i++) {
    const double middle = 0.5 * (low + high);
    const int before = middle <= a || (middle < b && (head_at(meridian, middle, design) < design->head) == upwards);
    *(before ? &low : &high) = middle;
  }
  return 0.5 * (low + high);
}

double cw_outlet_angle_for_head(const CwMeridian *meridian, const double range[2], const double usual[2],
                                CwDesign *design) {
  enum { STEPS = 96 };
  double a = range[0], at_a = head_at(meridian, a, design);
  double nearest = a, least = fabs(at_a - design->head), angle = NAN, least_away = HUGE_VAL;
  for (int i = 1; i <= STEPS; i++) {
    const double b = range[0] + (range[1] - range[0]) * i / STEPS, at_b = head_at(meridian, b, design);
    if (fabs(at_b - design->head) < least) {
      least = fabs(at_b - design->head);
      nearest = b;
    }
    if ((at_a < design->head) != (at_b < design->head)) {
      const double found = crossing(meridian, range, a, b, at_a < design->head, design);
      const double away = fmax(0, fmax(usual[0] - found, found - usual[1]));
      if (away < least_away) angle = found;
      least_away = fmin(least_away, away);
    }
    a = b;
    at_a = at_b;
  }
  if (isnan(angle)) angle = nearest;
  head_at(meridian, angle, design);
  return angle;
}

static CwTriangle triangle(double radius, double u, double cm, double cu, double blade_angle) {
  return (CwTriangle){.radius = radius,
                      .u = u,
                      .c_m = cm,
                      .c_u = cu,
                      .w = hypot(u - cu, cm),
                      .c = hypot(cu, cm),
                      .flow_angle = atan2(cm, u - cu),
                      .blade_angle = blade_angle};
}

static void to_space(const CwBladeSection *section, CwBladePoint point, double turn, double x[3]) {
  double rz[2];
  cw_meridian_blade_point(section->meridian, section->span, point.q, rz, NULL);
  x[0] = rz[0] * cos(point.theta + turn);
  x[1] = rz[0] * sin(point.theta + turn);
  x[2] = rz[1];
}

// Least distance at mid-span from the edge `from` of a blade to a side of its neighbour `section` turned by `turn`, and
// the place q there.
static double throat(const CwBladeSection *section, CwBladePoint from, CwBladeSide side, double turn, double *place) {
  enum { POINTS = 400 };
  double a[3], b[3], least = HUGE_VAL;
  to_space(section, from, 0, a);
  for (int i = 0; i <= POINTS; i++) {
    const CwBladePoint point =
        cw_blade_side(section, side, section->nose + (section->end - section->nose) * i / POINTS);
    to_space(section, point, turn, b);
    const double distance = sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
    if (distance < least) {
      least = distance;
      *place = 0.5 * (point.q + from.q);
    }
  }
  return least;
}

// From the end of a blade's suction side to the pressure side of the neighbour: of a blade with a splitter behind its
// pressure side the narrower of both passages.
static double outlet_throat(const CwDesign *design, const CwBladeSection *blade, double pitch) {
  double place;
  const CwBladePoint end = cw_blade_side(blade, CW_BLADE_SUCTION, blade->end);
  if (!(design->splitter_start > 0)) return throat(blade, end, CW_BLADE_PRESSURE, -pitch, &place);
  const CwBladeSection splitter = cw_blade_splitter(design, blade);
  const CwBladePoint its_end = cw_blade_side(&splitter, CW_BLADE_SUCTION, splitter.end);
  return fmin(throat(&splitter, end, CW_BLADE_PRESSURE, -pitch, &place),
              throat(blade, its_end, CW_BLADE_PRESSURE, 0, &place));
}

static double passage_width(const CwMeridian *meridian, double q) {
  double h[2], s[2];
  cw_meridian_blade_point(meridian, 0, q, h, NULL);
  cw_meridian_blade_point(meridian, 1, q, s, NULL);
  return hypot(h[0] - s[0], h[1] - s[1]);
}

CwStatus cw_velocity_triangles(const CwMeridian *meridian, double inlet_pressure, CwDesign *design) {
  CwStatus status = CW_OK;
  CwBladeSection section;
  const double pitch = 2 * M_PI / design->blade_count, omega = design->angular_speed;
  for (int j = 0; j < CW_TRIANGLE_SPANS; j++) {
    const double span = (double)j / (CW_TRIANGLE_SPANS - 1);
    double x[2];
    CW_TRY(cw_blade_section(design, meridian, span, &section));
    cw_meridian_blade_point(meridian, span, 0, x, NULL);
    const double beta = cw_blade_beta(&section, 0);
    const double tau = cw_blockage(design->blade_count, design->leading_edge_thickness, x[0], beta);
    design->inlet_triangle[j] = triangle(x[0], omega * x[0], design->inlet_meridional_speed * tau, 0, beta);
    design->outlet_triangle[j] =
        triangle(design->outlet_diameter / 2, design->impeller_tip_speed, design->outlet_meridional_speed,
                 design->outlet_swirl_speed, cw_blade_beta(&section, 1));
  }
  CW_TRY(cw_blade_section(design, meridian, 0.5, &section));
  double place = 0;
  SET(inlet_throat_width, throat(&section, cw_blade_leading_edge(&section, 0), CW_BLADE_SUCTION, pitch, &place),
      "least distance to the next blade, mid-span");
  SET(inlet_throat_area, design->blade_count * design->inlet_throat_width * passage_width(meridian, place), "z a1 b");
  SET(inlet_throat_ratio, design->water_flow_rate / design->inlet_throat_area / design->inlet_relative_speed,
      "Q / (throat area w1)");
  SET(outlet_throat_width, outlet_throat(design, &section, pitch), "least distance to the next blade, mid-span");
  // Guelich, section 6.3.2: lambda_c = 1.1 with an axial inlet, lambda_w = 0.3 tan(beta1B)^0.57 at the shroud.
  const CwTriangle *tip = &design->inlet_triangle[CW_TRIANGLE_SPANS - 1];
  const double cm = design->inlet_meridional_speed, w = hypot(tip->u, cm);
  const double lambda = 0.3 * pow(tan(tip->blade_angle), 0.57), rpm = omega * 30 / M_PI;
  SET(npsh_required, (1.1 * cm * cm + lambda * w * w) / (2 * CW_GRAVITY),
      "Guelich: 1.1 c_m1^2/2g + 0.3 tan(beta1)^0.57 w1^2/2g, shroud");
  SET(npsh_available, fmax(0, inlet_pressure - design->vapour_pressure) / (design->density * CW_GRAVITY),
      "(inlet pressure - vapour pressure) / (rho g)");
  SET(suction_specific_speed, rpm * sqrt(design->water_flow_rate) / pow(design->npsh_required, 0.75),
      "rpm, m3/s, m; 160 to 260 are usual");
done:
  return status;
}
