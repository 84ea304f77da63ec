// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_check.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "geometry/correlations.h"
#include "geometry/design_value.h"
#include "geometry/hydraulic_design.h"
#include "geometry/velocity_triangles.h"
#include "geometry/viscous_correction.h"
#include "geometry/volute_design.h"

static void remark(CwDesignRemarks *remarks, int wanted, const char *format, ...) __attribute__((format(printf, 3, 4)));

static void remark(CwDesignRemarks *remarks, int wanted, const char *format, ...) {
  if (!wanted || remarks->count == CW_DESIGN_REMARK_LIMIT) return;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(remarks->text[remarks->count++], sizeof remarks->text[0], format, arguments);
  va_end(arguments);
}

// Given values that lie further from both families' correlations than the design's share. A value that was
// computed comes from one of them.
static void against_correlations(const CwDesign *d, CwDesignRemarks *remarks) {
  static const CwCorrelated checked[] = {CW_CORRELATED_OUTLET_DIAMETER, CW_CORRELATED_OUTLET_WIDTH,
                                         CW_CORRELATED_INLET_DIAMETER,  CW_CORRELATED_HUB_DIAMETER,
                                         CW_CORRELATED_BLADE_THICKNESS, CW_CORRELATED_INLET_WIDTH};
  for (size_t i = 0; i < sizeof checked / sizeof *checked; i++) {
    const CwDesignValue value = cw_hydraulic_design_value(d, cw_correlated_quantity(checked[i]));
    const double a = 1e3 * cw_correlation(CW_CORRELATIONS_GUELICH, checked[i], d, NULL);
    const double b = 1e3 * cw_correlation(CW_CORRELATIONS_GUAN, checked[i], d, NULL);
    const int outside =
        value.shown < (1 - d->warn_share) * fmin(a, b) || value.shown > (1 + d->warn_share) * fmax(a, b);
    remark(remarks, outside && !strcmp(d->source[cw_correlated_quantity(checked[i])], "case"),
           "%s is %.4g mm; Guelich's correlation gives %.4g, Guan's %.4g mm (more than %.0f %% apart: "
           "design.warn_share)",
           value.text, value.shown, a, b, 100 * d->warn_share);
  }
}

// Given values that could not be had.
static void gave_way(const CwDesign *d, CwDesignRemarks *remarks) {
  for (int i = 0; i < CW_DESIGN_COUNT; i++) {
    const CwDesignValue value = cw_hydraulic_design_value(d, i);
    const int is_choice = value.asked == value.shown; // of a word, beside which the number says nothing
    remark(remarks, is_choice, "%s", d->source[i]);
    remark(remarks, !is_choice && !isnan(value.asked), "%s: %s is %.4g %s, the case asks for %.4g %s", d->source[i],
           value.text, value.shown, value.unit, value.asked, value.unit);
  }
}

// Where the sources of efficiency, shaft and viscous correction do not reach.
static void reach_of_sources(const CwDesign *d, CwDesignRemarks *remarks) {
  const double q = 3600 * d->water_flow_rate, rpm = d->angular_speed * 30 / M_PI;
  const int corrected = d->viscous_efficiency_factor < 1;
  remark(
      remarks, d->correlations == CW_CORRELATIONS_GUELICH && d->water_flow_rate < CW_GUELICH_LEAST_FLOW,
      "%.3g m3/h lie below the %.0f m3/h to which Guelich's efficiencies reach; %.0f %% (hydraulic %.0f %%) continue "
      "his losses to this size",
      q, 3600 * CW_GUELICH_LEAST_FLOW, 100 * d->efficiency, 100 * d->hydraulic_efficiency);
  remark(remarks, d->correlations == CW_CORRELATIONS_GUAN && d->water_flow_rate < CW_GUAN_LEAST_FLOW,
         "%.3g m3/h lie below the %.0f m3/h to which Guan's efficiencies reach; %.0f %% (hydraulic %.0f %%) are more "
         "than so small a pump has: take design.correlations guelich, which continues the losses",
         q, 3600 * CW_GUAN_LEAST_FLOW, 100 * d->efficiency, 100 * d->hydraulic_efficiency);
  remark(remarks, d->specific_speed_nq > 100,
         "nq is %.0f; the correlations are those of radial wheels, nq up to 100: speed_rpm of at most %.4g",
         d->specific_speed_nq, rpm * 100 / d->specific_speed_nq);
  remark(remarks, d->correlations == CW_CORRELATIONS_GUAN && (d->specific_speed_ns < 30 || d->specific_speed_ns > 300),
         "ns is %.0f; Guan's formulas are those of centrifugal pumps of ns 30 to 300: take design.correlations guelich",
         d->specific_speed_ns);
  remark(remarks,
         d->volute.input.area_law == CW_AREA_LAW_VELOCITY && strcmp(d->source[CW_DESIGN_section_speed], "case: K3") &&
             (d->specific_speed_nq < 10 || d->specific_speed_nq > 40),
         "nq is %.0f; Stepanoff's velocity factor was read off for nq 10 to 40: compare area_law angular_momentum, or "
         "give velocity_factor",
         d->specific_speed_nq);
  remark(
      remarks, d->hub_diameter < 1.1 * d->shaft_diameter,
      "the hub of %.4g mm has no room for the shaft of %.4g mm that the torque at %.0f rpm asks for: a stronger shaft, "
      "or hub_diameter_mm of at least %.4g",
      1e3 * d->hub_diameter, 1e3 * d->shaft_diameter, rpm, 1.1e3 * d->shaft_diameter);
  remark(remarks, corrected && d->viscous_parameter > CW_VISCOUS_LARGEST_B,
         "the viscosity of %.4g cSt gives B = %.0f; ANSI/HI 9.6.7 has factors up to B = %.0f, which are taken",
         1e6 * d->viscosity, d->viscous_parameter, CW_VISCOUS_LARGEST_B);
  remark(
      remarks,
      corrected && (q < 3 || q > 410 || d->water_head < 6 || d->water_head > 130 || d->specific_speed_nq > 60 ||
                    d->viscosity > CW_VISCOUS_LARGEST_NU),
      "the viscous correction of ANSI/HI 9.6.7 was held against pumps of 3 to 410 m3/h and 6 to 130 m with nq up to 60 "
      "and up to %.0f cSt; this one has %.3g m3/h and %.3g m with water",
      1e6 * CW_VISCOUS_LARGEST_NU, q, d->water_head);
  remark(remarks, corrected,
         "the NPSH3 of %.3g m is that with water: no correction of it for the viscosity of %.4g cSt is built in; it "
         "rises with the viscosity, so leave a margin between it and the %.4g m that "
         "operating_point.inlet_pressure_pa gives",
         d->npsh_required, 1e6 * d->viscosity, d->npsh_available);
}

// tan beta1 falls as 1/r: at mid-span it must leave 12 deg where the leading edge is farthest out.
static void of_incidence(const CwDesign *d, CwDesignRemarks *remarks) {
  const double flow = d->inlet_flow_angle / CW_DEGREE, radius = d->inlet_blade_speed / d->angular_speed;
  const double farthest = fmax(d->leading_edge_radius_hub, d->leading_edge_radius_shroud);
  const double least = atan(tan(12 * CW_DEGREE) * farthest / radius) / CW_DEGREE;
  const double low = ceil(10 * fmax(least, flow - 2)) / 10, high = flow + 8;
  const int unusual = d->incidence > 8 * CW_DEGREE || d->incidence < -2 * CW_DEGREE;
  remark(
      remarks, unusual && low < high,
      "the blades meet the flow with an incidence of %.1f deg; -2 to 8 deg are usual: inlet_blade_angle_deg of about "
      "%.1f to %.1f",
      d->incidence / CW_DEGREE, low, high);
  remark(
      remarks, unusual && low >= high,
      "the blades meet the flow with an incidence of %.1f deg; -2 to 8 deg are usual, but the flow comes at %.1f deg "
      "and blades have 12 deg and more: lower inlet_diameter_mm and the leading edge radii",
      d->incidence / CW_DEGREE, flow);
}

static void of_blades(const CwDesign *d, CwDesignRemarks *remarks) {
  of_incidence(d, remarks);
  const double edge = fmax(d->leading_edge_thickness, d->trailing_edge_thickness);
  remark(remarks, edge > (1 + 1e-9) * d->blade_thickness,
         "the blades have %.3g mm at an edge and %.3g mm between, where they should be thickest: give "
         "blade_thickness_mm of %.4g or more",
         1e3 * edge, 1e3 * d->blade_thickness, 1e3 * edge);
  remark(remarks, d->diffusion_ratio < 0.7,
         "w2 / w1 is %.2f; under 0.7 the flow in the wheel tends to separate: lower outlet_width_mm",
         d->diffusion_ratio);
  remark(remarks, d->diffusion_ratio > 1.1,
         "w2 / w1 is %.2f; 0.7 to 1 are usual: the wheel accelerates its flow; raise outlet_width_mm",
         d->diffusion_ratio);
  const int few = d->overlap < 1;
  remark(remarks, d->overlap < 0.8 || d->overlap > 3.2,
         "the blades overlap by %.2f of the pitch; 1.0 to 1.6 are usual, up to 3 at low specific speed: %s "
         "wrap_angle_deg to %.0f, or blade_count",
         d->overlap, few ? "raise" : "lower", (few ? 1 : 3) * 360.0 / d->blade_count);
  const char *at_hub = d->source[CW_DESIGN_leading_edge_radius_hub];
  const char *at_shroud = d->source[CW_DESIGN_leading_edge_radius_shroud];
  remark(remarks, strstr(at_hub, "at the eye") != NULL,
         "leading_edge_radius_hub_mm lies at the hub's begin or inside it: the blades begin there at r = %.4g mm, %s",
         1e3 * d->leading_edge_radius_hub, at_hub);
  remark(remarks, strstr(at_shroud, "at the eye") != NULL,
         "leading_edge_radius_shroud_mm lies at the eye or inside it: the blades begin at r = %.4g mm, %s",
         1e3 * d->leading_edge_radius_shroud, at_shroud);
  remark(remarks, !strcmp(d->source[CW_DESIGN_wrap_angle], CW_WRAP_WITHIN_A_REVOLUTION),
         "the wrap is %.0f deg, the greatest with which no passage of %d blades%s winds round the axis, and the blade "
         "angles follow it; more blade_count have room for more",
         d->wrap_angle / CW_DEGREE, d->blade_count, d->splitter_start > 0 ? " and as many splitters" : "");
  remark(remarks, d->wrap_spread != 0 && strcmp(d->source[CW_DESIGN_wrap_spread], "case"),
         "the wrap at the shroud differs by %.0f deg from that at the hub, so that the blade angles stay within 12 to "
         "60 deg and the blades stand steep on the walls; wrap_spread_deg gives another difference",
         d->wrap_spread / CW_DEGREE);
  remark(remarks, d->inlet_throat_ratio < 0.55 || d->inlet_throat_ratio > 1,
         "the flow in the inlet throat has %.2f of w1; 0.65 to 0.9 are usual: %s", d->inlet_throat_ratio,
         d->inlet_throat_ratio > 1 ? "raise inlet_blade_angle_deg or lower blade_count"
                                   : "lower inlet_blade_angle_deg or raise blade_count");
}

// ", or leave out" those of the poles that the case gives.
static void given_poles(const CwDesign *d, char text[80]) {
  static const struct {
    CwDesignQuantity quantity;
    const char *key;
  } poles[] = {{CW_DESIGN_hub_pole_radial, "hub_pole_radial"},
               {CW_DESIGN_shroud_pole_axial, "shroud_pole_axial"},
               {CW_DESIGN_shroud_pole_radial, "shroud_pole_radial"}};
  size_t used = 0;
  *text = '\0';
  for (size_t i = 0; i < sizeof poles / sizeof *poles; i++)
    if (!strcmp(d->source[poles[i].quantity], "case"))
      used += (size_t)snprintf(text + used, 80 - used, "%s %s", used ? " and" : ", or leave out", poles[i].key);
}

static void of_passage(const CwDesign *d, CwDesignRemarks *remarks) {
  char poles[80];
  given_poles(d, poles);
  remark(remarks, d->passage_area_reversal > 1e-3,
         "the passage's area goes from %.3g mm2 in the eye to %.3g mm2 at D2, but steps back by %.1f %% on its way; "
         "0.1 %% are usual: change axial_length_mm%s",
         d->passage_area_eye * 1e6, d->passage_area_outlet * 1e6, 100 * d->passage_area_reversal, poles);
  remark(remarks, d->shroud_bend_radius < 0.6 * d->inlet_passage_width,
         "the shroud bends with a radius of %.3g mm, %.2f of the passage's width there; at least 0.6 (%.3g mm) are "
         "usual: raise axial_length_mm",
         d->shroud_bend_radius * 1e3, d->shroud_bend_radius / d->inlet_passage_width, 0.6e3 * d->inlet_passage_width);
  remark(remarks, d->npsh_required > d->npsh_available,
         "the wheel needs an NPSH of about %.1f m, the inlet pressure gives %.1f m (vapour pressure %.0f Pa): raise "
         "operating_point.inlet_pressure_pa to %.0f",
         d->npsh_required, d->npsh_available, d->vapour_pressure,
         ceil(d->vapour_pressure + d->density * CW_GRAVITY * d->npsh_required));
}

// The gap of the tongue that the spiral has room for and that is nearest to the wanted one, whatever the diffuser; NAN:
// none. With what three digits may be off by, it is no less, or no more, than can be had.
static double nearest_gap(const CwVolute *volute, double wanted) {
  const double digits = 5e-3, slack = CW_VOLUTE_TONGUE_SLACK * volute->input.base_diameter / 2;
  CwVoluteInput input = volute->input;
  CwVolute with_gap;
  input.tongue_gap = fmax(0, wanted);
  input.tongue_angle = input.outlet_diameter = input.diffuser_area_ratio = input.diffuser_length = NAN;
  if (cw_volute_design(&input, &with_gap) != CW_OK) {
    cw_fail_clear();
    return NAN;
  }
  const double gap = with_gap.tip_radius - input.base_diameter / 2;
  return gap > input.tongue_gap + slack   ? (1 + digits) * gap
         : gap < input.tongue_gap - slack ? (1 - digits) * gap
                                          : input.tongue_gap;
}

// 1.05 to 1.2 of the wheel's radius, as far as the spiral has room for such a gap.
static void of_tongue(const CwDesign *d, CwDesignRemarks *remarks) {
  const double d2 = d->outlet_diameter, r3 = d->base_diameter / 2, tip = 2 * d->tongue_tip_radius / d2;
  const int by_angle = !strcmp(d->source[CW_DESIGN_tongue_angle], "case") || !isnan(d->asked[CW_DESIGN_tongue_angle]);
  const int unusual = tip < 1.045 || tip > 1.25;
  const double largest = 1.2 * d2 / 2 - r3;
  const double least = unusual ? nearest_gap(&d->volute, 1.05 * d2 / 2 - r3) : NAN;
  const double most = least < largest ? nearest_gap(&d->volute, largest) : NAN;
  const int usual = least < most;
  remark(remarks, unusual && usual,
         "the tongue's tip lies at %.3f of the wheel's radius; 1.05 to 1.2 are usual: tongue_gap_mm of %.3g to %.3g%s",
         tip, 1e3 * least, 1e3 * most, by_angle ? " in place of tongue_angle_deg" : "");
  remark(remarks, unusual && !usual,
         "the tongue's tip lies at %.3f of the wheel's radius; 1.05 to 1.2 are usual: base_diameter_mm of %s %.4g", tip,
         tip > 1.25 ? "at most" : "at least", 1e3 * d2 * (tip > 1.25 ? 1.08 : 1.05));
}

static void of_volute(const CwDesign *d, CwDesignRemarks *remarks) {
  const double d2 = d->outlet_diameter;
  remark(remarks, d->base_diameter < 1.03 * d2 || d->base_diameter > 1.15 * d2,
         "D3 is %.3f D2; 1.03 to 1.08 are usual: base_diameter_mm of %.4g to %.4g", d->base_diameter / d2, 1.03e3 * d2,
         1.08e3 * d2);
  of_tongue(d, remarks);
  const CwVolute *v = &d->volute;
  const double touching = 0.5 * M_PI + v->input.side_wall_angle;
  remark(
      remarks, v->input.section == CW_SECTION_CIRCLE && v->end_half_angle < touching - 1e-9,
      "section circle: the spiral has no room for circles that touch its side walls; its arcs end at %.0f instead of "
      "%.0f deg: lower side_wall_angle_deg or inlet_width_mm, or take section trapezoid",
      v->end_half_angle / CW_DEGREE, touching / CW_DEGREE);
  const int angle_given = !strcmp(d->source[CW_DESIGN_diffuser_length], "full angle of the case");
  const double length = 1e3 * d->diffuser_length * tan(0.5 * d->diffuser_angle) / tan(5 * CW_DEGREE);
  remark(remarks, d->diffuser_angle > 10.05 * CW_DEGREE,
         "the diffuser opens by %.1f deg; at most 10 deg are usual: %s %.4g", d->diffuser_angle / CW_DEGREE,
         angle_given ? "lower diffuser_angle_deg to" : "raise diffuser_length_mm to", angle_given ? 10 : length);
  const double throat_diameter = d->discharge_diameter / sqrt(d->diffuser_area_ratio);
  const int ratio_given = !strcmp(d->source[CW_DESIGN_diffuser_area_ratio], "case");
  remark(remarks, d->diffuser_area_ratio < 1.45 || d->diffuser_area_ratio > 3.05,
         "the diffuser has an area ratio of %.2f; 1.5 to 3 are usual: %s of %.4g to %.4g", d->diffuser_area_ratio,
         ratio_given ? "diffuser_area_ratio" : "outlet_diameter_mm",
         ratio_given ? 1.5 : 1e3 * sqrt(1.5) * throat_diameter, ratio_given ? 3 : 1e3 * sqrt(3) * throat_diameter);
}

// Splitters leave the inlet to the blades alone: what is wanted may lie between these and all by their length.
static void of_blade_count(const CwDesign *d, CwDesignRemarks *remarks) {
  const double wanted = 6.5 * (d->outlet_diameter + d->inlet_diameter) / (d->outlet_diameter - d->inlet_diameter) *
                        sin(0.5 * (d->inlet_blade_angle + d->outlet_blade_angle));
  const double all = cw_slip_blades(d);
  const int few = wanted > all + 1.5, unusual = (few || wanted < d->blade_count - 1.5) && d->specific_speed_nq < 45;
  const int splitters = d->splitter_start > 0;
  remark(remarks, unusual && !splitters,
         "%d blades; Pfleiderer's 6.5 (D2 + D1)/(D2 - D1) sin(mean beta) gives a blade_count of %.1f", d->blade_count,
         wanted);
  remark(
      remarks, unusual && splitters,
      "%d blades, %.1f with the splitters by their length; Pfleiderer's 6.5 (D2 + D1)/(D2 - D1) sin(mean beta) gives "
      "%.1f: a blade_count of %.1f",
      d->blade_count, all, wanted, few ? wanted * d->blade_count / all : wanted);
}

void cw_design_check(const CwDesign *d, CwDesignRemarks *remarks) {
  remarks->count = 0;
  gave_way(d, remarks);
  against_correlations(d, remarks);
  of_blade_count(d, remarks);
  remark(
      remarks, fabs(d->head_residual) > 0.03 * d->head,
      "the design predicts a head of %.4g m, the table asks for %.4g m: its dimensions, wrap and blade angles do not "
      "fit that head, and go before it unless impeller.priority is head",
      d->predicted_head, d->head);
  remark(remarks, fabs(d->wrap_residual) > 0.1 * CW_DEGREE && isnan(d->asked[CW_DESIGN_wrap_angle]),
         "the wrap is %.2f deg, the table asks for %.2f deg: impeller.priority decides", d->wrap_angle / CW_DEGREE,
         (d->wrap_angle - d->wrap_residual) / CW_DEGREE);
  remark(remarks, fabs(d->outlet_angle_residual) > 0.1 * CW_DEGREE,
         "beta2 is %.2f deg, the table asks for %.2f deg: impeller.priority decides", d->outlet_blade_angle / CW_DEGREE,
         (d->outlet_blade_angle - d->outlet_angle_residual) / CW_DEGREE);
  of_blades(d, remarks);
  of_passage(d, remarks);
  of_volute(d, remarks);
  reach_of_sources(d, remarks);
}
