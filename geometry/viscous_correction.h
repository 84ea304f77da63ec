// SPDX-License-Identifier: AGPL-3.0-or-later
// Head, flow rate and efficiency of a pump with a viscous fluid over those with water, at the best point:
// ANSI/HI 9.6.7, Effects of liquid viscosity on rotodynamic pump performance.
//
//   B = 16.5 nu^0.5 H^0.0625 / (Q^0.375 n^0.25), nu in cSt, H in m, Q in m3/h, n in rpm, H and Q with water;
//   C_H = C_Q = exp(-0.165 (lg B)^3.15), C_eta = B^(-0.0547 B^0.69) for 1 < B < 40; 1 for B <= 1.
//
// The standard's factors refer to water. With small pumps B is more than 1 for water too; the factors here are those of
// the fluid over those of water at 20 degrees Celsius in the same pump. A thinner fluid has no factors.
#pragma once

#define CW_VISCOUS_LARGEST_B 40.0  // beyond it the standard has no factors; those of it are taken
#define CW_VISCOUS_WATER 1.004e-6  // m2/s
#define CW_VISCOUS_LARGEST_NU 4e-3 // m2/s, the largest viscosity that the standard was held against

typedef struct {
  double parameter;        // B of the fluid
  double head, efficiency; // C_H, which is C_Q, and C_eta
} CwViscousCorrection;

// B of a pump with the flow rate (m3/s), head (m) and speed (rad/s) of its best point with water.
double cw_viscous_parameter(double viscosity, double flow_rate, double head, double speed);

// The factors of a pump whose best point with water is given.
CwViscousCorrection cw_viscous_correction(double viscosity, double flow_rate, double head, double speed);

// The same of the pump whose best point with the fluid is given: with water it has flow_rate / C_Q and head / C_H.
CwViscousCorrection cw_viscous_selection(double viscosity, double flow_rate, double head, double speed);
