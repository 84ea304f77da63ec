// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_check.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "geometry/correlations.h"

static const double degree = M_PI / 180;

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
           "%s is %.4g mm; Guelich's correlation gives %.4g, Guan's %.4g mm (more than %.0f %% apart)", value.text,
           value.shown, a, b, 100 * d->warn_share);
  }
}

void cw_design_check(const CwDesign *d, CwDesignRemarks *remarks) {
  const double blades = 6.5 * (d->outlet_diameter + d->inlet_diameter) / (d->outlet_diameter - d->inlet_diameter) *
                        sin(0.5 * (d->inlet_blade_angle + d->outlet_blade_angle));
  remarks->count = 0;
  against_correlations(d, remarks);
  remark(remarks, fabs(d->blade_count - blades) > 1.5 && d->specific_speed_nq < 45,
         "%d blades; Pfleiderer's 6.5 (D2 + D1)/(D2 - D1) sin(mean beta) gives %.1f", d->blade_count, blades);
  remark(remarks, fabs(d->head_residual) > 0.03 * d->head,
         "the design predicts a head of %.2f m, the table asks for %.2f m: wrap, blade angles and head do "
         "not fit one another, and the priority decides",
         d->predicted_head, d->head);
  remark(remarks, fabs(d->wrap_residual) > 0.1 * degree,
         "the wrap is %.2f deg, the table asks for %.2f deg: the priority decides", d->wrap_angle / degree,
         (d->wrap_angle - d->wrap_residual) / degree);
  remark(remarks, fabs(d->outlet_angle_residual) > 0.1 * degree,
         "beta2 is %.2f deg, the table asks for %.2f deg: the priority decides", d->outlet_blade_angle / degree,
         (d->outlet_blade_angle - d->outlet_angle_residual) / degree);
  remark(remarks, d->incidence > 8 * degree || d->incidence < -2 * degree,
         "the blades meet the flow with an incidence of %.1f deg; -2 to 8 deg are usual", d->incidence / degree);
  remark(remarks, d->diffusion_ratio < 0.7, "w2 / w1 is %.2f; under 0.7 the flow in the wheel tends to separate",
         d->diffusion_ratio);
  remark(remarks, d->overlap < 0.8, "the blades overlap by %.2f of the pitch; 1.0 to 1.6 are usual: raise the wrap",
         d->overlap);
  remark(remarks, d->wrap_spread != 0,
         "the wrap at the shroud differs by %.0f deg from that at the hub, so that the blade angles stay "
         "within 12 to "
         "60 deg and the blades stand steep on the walls",
         d->wrap_spread / degree);
  remark(remarks, d->inlet_throat_ratio < 0.55 || d->inlet_throat_ratio > 1,
         "the flow in the inlet throat has %.2f of w1; 0.65 to 0.9 are usual", d->inlet_throat_ratio);
  remark(remarks, d->passage_area_reversal > 1e-3,
         "the passage's area goes from %.0f mm2 in the eye to %.0f mm2 at D2, but steps back by %.1f %% on its way: "
         "change axial_length_mm or the poles of hub and shroud, or leave them out",
         d->passage_area_eye * 1e6, d->passage_area_outlet * 1e6, 100 * d->passage_area_reversal);
  remark(remarks, d->shroud_bend_radius < 0.6 * d->inlet_passage_width,
         "the shroud bends with a radius of %.1f mm, %.2f of the passage's width there; at least 0.6 are usual",
         d->shroud_bend_radius * 1e3, d->shroud_bend_radius / d->inlet_passage_width);
  remark(remarks, d->npsh_required > d->npsh_available,
         "the wheel needs an NPSH of about %.1f m, the inlet pressure gives %.1f m (cold water)", d->npsh_required,
         d->npsh_available);
  remark(remarks, d->base_diameter < 1.03 * d->outlet_diameter, "D3 is %.3f D2; 1.03 to 1.08 are usual",
         d->base_diameter / d->outlet_diameter);
  remark(remarks, d->diffuser_angle > 10 * degree, "the diffuser opens by %.1f deg; at most 10 deg are usual",
         d->diffuser_angle / degree);
}
