// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/water.h"

#include <math.h>

static const double ZERO_CELSIUS = 273.15;          // K
static const double CRITICAL_TEMPERATURE = 647.096; // K
static const double CRITICAL_PRESSURE = 22.064e6;   // Pa
static const double CRITICAL_DENSITY = 322;         // kg/m3

// Sum of a_i tau^e_i, tau = 1 - T / Tc.
static double series(double celsius, const double terms[6][2]) {
  const double tau = 1 - (celsius + ZERO_CELSIUS) / CRITICAL_TEMPERATURE;
  double sum = 0;
  for (int i = 0; i < 6; i++) sum += terms[i][0] * pow(tau, terms[i][1]);
  return sum;
}

double cw_water_vapour_pressure(double celsius) {
  static const double terms[6][2] = {{-7.85951783, 1},  {1.84408259, 1.5}, {-11.7866497, 3},
                                     {22.6807411, 3.5}, {-15.9618719, 4},  {1.80122502, 7.5}};
  return CRITICAL_PRESSURE * exp(CRITICAL_TEMPERATURE / (celsius + ZERO_CELSIUS) * series(celsius, terms));
}

double cw_water_density(double celsius) {
  static const double terms[6][2] = {{1.99274064, 1.0 / 3},   {1.09965342, 2.0 / 3},   {-0.510839303, 5.0 / 3},
                                     {-1.75493479, 16.0 / 3}, {-45.5170352, 43.0 / 3}, {-6.74694450e5, 110.0 / 3}};
  return CRITICAL_DENSITY * (1 + series(celsius, terms));
}

double cw_water_viscosity(double celsius, double density) {
  static const double dilute[4] = {1.67752, 2.20462, 0.6366564, -0.241605};
  // H_ij, i over 1 / T - 1, j over rho - 1, both reduced.
  static const double finite[6][7] = {
      {5.20094e-1, 2.22531e-1, -2.81378e-1, 1.61913e-1, -3.25372e-2, 0, 0},
      {8.50895e-2, 9.99115e-1, -9.06851e-1, 2.57399e-1, 0, 0, 0},
      {-1.08374, 1.88797, -7.72479e-1, 0, 0, 0, 0},
      {-2.89555e-1, 1.26613, -4.89837e-1, 0, 6.98452e-2, 0, -4.35673e-3},
      {0, 0, -2.57040e-1, 0, 0, 8.72102e-3, 0},
      {0, 1.20573e-1, 0, 0, 0, 0, -5.93264e-4},
  };
  const double t = (celsius + ZERO_CELSIUS) / CRITICAL_TEMPERATURE, rho = density / CRITICAL_DENSITY;
  double denominator = 0, exponent = 0;
  for (int i = 0; i < 4; i++) denominator += dilute[i] / pow(t, i);
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 7; j++) exponent += finite[i][j] * pow(1 / t - 1, i) * pow(rho - 1, j);
  return 1e-6 * 100 * sqrt(t) / denominator * exp(rho * exponent);
}

double cw_water_kinematic_viscosity(double celsius) {
  const double density = cw_water_density(celsius);
  return cw_water_viscosity(celsius, density) / density;
}
