// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_check.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

static const double gravity = 9.80665;
static const double degree = M_PI / 180;

static void remark(CwDesignRemarks *remarks, int wanted, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void remark(CwDesignRemarks *remarks, int wanted, const char *format, ...) {
  if (!wanted || remarks->count == CW_DESIGN_REMARK_LIMIT)
    return;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(remarks->text[remarks->count++], sizeof remarks->text[0], format, arguments);
  va_end(arguments);
}

// Whether a value lies more than a tenth outside a range.
static int outside(double value, double least, double largest) {
  return value < 0.9 * fmin(least, largest) || value > 1.1 * fmax(least, largest);
}

void cw_design_check(const CwDesign *d, CwDesignRemarks *remarks) {
  const double rpm = d->angular_speed * 30 / M_PI, guan = cbrt(d->flow_rate / rpm), nq = d->specific_speed_nq;
  const double psi = 1.21 * exp(-0.77 * nq / 100);
  const double d2_gulich = 2 / d->angular_speed * sqrt(2 * gravity * d->head / psi);
  const double d2_guan = 9.35 / sqrt(d->specific_speed_ns / 100) * guan;
  const double b2_guan = 0.64 * pow(d->specific_speed_ns / 100, 5.0 / 6) * guan;
  const double hub = d->hub_diameter / d->outlet_diameter;
  const double d1 = d->outlet_diameter * sqrt(hub * hub + 1.5e-3 * d->head_coefficient * pow(nq, 1.33));
  const double blades = 6.5 * (d->outlet_diameter + d->inlet_diameter) /
                        (d->outlet_diameter - d->inlet_diameter) *
                        sin(0.5 * (d->inlet_blade_angle + d->outlet_blade_angle));
  remarks->count = 0;
  remark(remarks, outside(d->outlet_diameter, d2_gulich, d2_guan),
         "D2 is %.1f mm; Gulich's psi gives %.1f, Guan's correlation %.1f mm", d->outlet_diameter * 1e3,
         d2_gulich * 1e3, d2_guan * 1e3);
  remark(remarks, outside(d->outlet_width, b2_guan, b2_guan),
         "b2 is %.2f mm; Guan's correlation gives %.2f mm", d->outlet_width * 1e3, b2_guan * 1e3);
  remark(remarks, outside(d->inlet_diameter, 1.12 * d1, 1.2 * d1),
         "D1 is %.1f mm; Gulich's correlation gives %.1f to %.1f mm", d->inlet_diameter * 1e3,
         1.12 * d1 * 1e3, 1.2 * d1 * 1e3);
  remark(remarks, fabs(d->blade_count - blades) > 1.5,
         "%d blades; Pfleiderer's 6.5 (D2 + D1)/(D2 - D1) sin(mean beta) gives %.1f", d->blade_count, blades);
  remark(remarks, fabs(d->head_residual) > 0.03 * d->head,
         "the design predicts a head of %.2f m, the table asks for %.2f m: wrap, blade angles and head do "
         "not fit one "
         "another, and the priority decides",
         d->predicted_head, d->head);
  remark(remarks, fabs(d->wrap_residual) > 0.1 * degree,
         "the wrap is %.2f deg, the table asks for %.2f deg: the priority decides", d->wrap_angle / degree,
         (d->wrap_angle - d->wrap_residual) / degree);
  remark(remarks, d->incidence > 8 * degree || d->incidence < -2 * degree,
         "the blades meet the flow with an incidence of %.1f deg; -2 to 8 deg are usual",
         d->incidence / degree);
  remark(remarks, d->diffusion_ratio < 0.7,
         "w2 / w1 is %.2f; under 0.7 the flow in the wheel tends to separate", d->diffusion_ratio);
  remark(remarks, d->base_diameter < 1.03 * d->outlet_diameter, "D3 is %.3f D2; 1.03 to 1.08 are usual",
         d->base_diameter / d->outlet_diameter);
  remark(remarks, d->diffuser_angle > 10 * degree, "the diffuser opens by %.1f deg; at most 10 deg are usual",
         d->diffuser_angle / degree);
}
