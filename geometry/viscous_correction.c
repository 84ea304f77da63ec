// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/viscous_correction.h"

#include <math.h>

double cw_viscous_parameter(double viscosity, double flow_rate, double head, double speed) {
  const double rpm = speed * 30 / M_PI;
  return 16.5 * sqrt(1e6 * viscosity) * pow(head, 0.0625) / (pow(3600 * flow_rate, 0.375) * pow(rpm, 0.25));
}

static double head_factor(double b) {
  return b > 1 ? exp(-0.165 * pow(log10(fmin(b, CW_VISCOUS_LARGEST_B)), 3.15)) : 1;
}

static double efficiency_factor(double b) {
  b = fmin(b, CW_VISCOUS_LARGEST_B);
  return b > 1 ? pow(b, -0.0547 * pow(b, 0.69)) : 1;
}

CwViscousCorrection cw_viscous_correction(double viscosity, double flow_rate, double head, double speed) {
  const double b = cw_viscous_parameter(viscosity, flow_rate, head, speed);
  if (viscosity <= CW_VISCOUS_WATER) return (CwViscousCorrection){b, 1, 1};
  const double water = cw_viscous_parameter(CW_VISCOUS_WATER, flow_rate, head, speed);
  return (CwViscousCorrection){b, head_factor(b) / head_factor(water), efficiency_factor(b) / efficiency_factor(water)};
}

CwViscousCorrection cw_viscous_selection(double viscosity, double flow_rate, double head, double speed) {
  // B falls as C_H^0.3125: each round brings the factor nearer.
  enum { ROUNDS = 60 };
  CwViscousCorrection correction = cw_viscous_correction(viscosity, flow_rate, head, speed);
  for (int i = 0; i < ROUNDS; i++)
    correction = cw_viscous_correction(viscosity, flow_rate / correction.head, head / correction.head, speed);
  return correction;
}
