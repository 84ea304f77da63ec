// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/correlations.h"

#include <math.h>

// A small pump of low efficiency needs a far larger D2 for its head; its width follows D2 up to so many times the
// correlation's.
static const double LARGEST_GROWTH = 1.2;
static const double LEAST_WIDENING = 0.006; // of D2, from b2 to b3

// Guelich, table 3.9, single-stage radial pumps: 1 - a Q^-m - b (c - lg(nq / d))^2 Q^-e with Q in m3/s.
typedef struct {
  double a, b, c, reference, e, exponent;
} Efficiency;

static double guelich_table(const Efficiency *table, double nq, double flow_rate) {
  const double inverse = 1 / flow_rate, large = flow_rate > 1 ? 0.5 : 1;
  const double m = table->exponent * large * pow(inverse, 0.15) * pow(45 / nq, 0.06);
  const double off = table->c - log10(nq / table->reference);
  return 1 - table->a * pow(inverse, m) - table->b * off * off * pow(inverse, table->e);
}

// Below the flow rate to which the table reaches, its ratio of losses (1 - eta) / eta goes on as a power of Q with the
// value and the slope that it has there: the efficiency falls all the way to 0 with Q, and the table would be negative.
static double guelich_efficiency(const CwDesign *d, const Efficiency *table) {
  const double nq = d->specific_speed_nq, q = d->water_flow_rate, least = CW_GUELICH_LEAST_FLOW, step = 1e-4;
  const double at = guelich_table(table, nq, fmax(q, least));
  if (q >= least) return at;
  const double above = guelich_table(table, nq, least * (1 + step)), losses = (1 - at) / at;
  const double power = log((1 - above) / above / losses) / log1p(step);
  return 1 / (1 + losses * pow(q / least, power));
}

// (Q/n)^(1/3) with n in rpm, m: the size in Guan's formulas.
static double guan_size(const CwDesign *d) {
  return cbrt(d->water_flow_rate / (d->angular_speed * 30 / M_PI));
}

// d = (16 M / (pi tau))^(1/3): with M = P / omega this is Guelich's 3.65 (P / (n tau))^(1/3).
static double torsion_diameter(const CwDesign *d, double stress) {
  return cbrt(16 * d->shaft_power / d->angular_speed / (M_PI * stress));
}

static double guelich_diameter(const CwDesign *d) {
  return 2 / d->angular_speed * sqrt(2 * CW_GRAVITY * d->water_head / (1.21 * exp(-0.77 * d->specific_speed_nq / 100)));
}

// A hub that the shaft asks for, within what stiffness needs and the eye leaves room for.
static double hub(double by_shaft, double d2, const char *shaft_source, const char **source) {
  *source = by_shaft < 0.12 * d2                   ? "stiffness: 0.12 D2"
            : by_shaft > CW_LARGEST_HUB_SHARE * d2 ? "at most 0.35 D2, which leaves the eye open"
                                                   : shaft_source;
  return fmin(CW_LARGEST_HUB_SHARE * d2, fmax(0.12 * d2, by_shaft));
}

static double guelich(CwCorrelated quantity, const CwDesign *d, const char **source) {
  const double nq = d->specific_speed_nq, d2 = d->outlet_diameter, share = d->hub_diameter / d2;
  const int small = d->water_flow_rate < CW_GUELICH_LEAST_FLOW;
  switch (quantity) {
  case CW_CORRELATED_EFFICIENCY:
    *source = small ? "Guelich, table 3.9, its losses continued below 18 m3/h" : "Guelich, table 3.9";
    return guelich_efficiency(d, &(Efficiency){0.095, 0.3, 0.35, 23, 0.05, 0.1});
  case CW_CORRELATED_HYDRAULIC_EFFICIENCY:
    *source = small ? "Guelich, table 3.9, its losses continued below 18 m3/h" : "Guelich, table 3.9";
    return guelich_efficiency(d, &(Efficiency){0.055, 0.2, 0.26, 25, 0.1, 0.08});
  case CW_CORRELATED_SHAFT_DIAMETER:
    *source = "Guelich: 3.65 (1.2 P / (n tau))^(1/3), tau = 20 MPa";
    return cbrt(1.2) * torsion_diameter(d, 20e6);
  case CW_CORRELATED_OUTLET_DIAMETER:
    *source = "Guelich: psi = 1.21 exp(-0.77 nq/100)";
    return guelich_diameter(d);
  case CW_CORRELATED_HUB_DIAMETER:
    return hub(1.35 * d->shaft_diameter, d2, "1.35 shaft diameters", source);
  case CW_CORRELATED_OUTLET_WIDTH:
    *source = "Guelich: b2/D2 = 0.017 + 0.262 x - 0.08 x^2 + 0.0093 x^3, x = nq/100";
    return fmin(d2, LARGEST_GROWTH * guelich_diameter(d)) *
           (0.017 + nq / 100 * (0.262 + nq / 100 * (-0.08 + nq / 100 * 0.0093)));
  case CW_CORRELATED_INLET_DIAMETER:
    *source = "Guelich: D1/D2 = 1.16 ((dn/D2)^2 + 1.5e-3 psi nq^1.33)^0.5";
    return d2 * 1.16 * sqrt(share * share + 1.5e-3 * d->head_coefficient * pow(nq, 1.33));
  case CW_CORRELATED_BLADE_COUNT:
    *source = "Guelich: 5 to 7; 7 under nq 18, 6 under 45";
    return nq < 18 ? 7 : nq < 45 ? 6 : 5;
  case CW_CORRELATED_BLADE_THICKNESS:
    *source = "Guelich: 0.016 to 0.022 D2";
    return 0.020 * d2;
  case CW_CORRELATED_INCIDENCE:
    *source = "Guelich: 0 to 4 deg";
    return 4 * CW_DEGREE;
  case CW_CORRELATED_BASE_DIAMETER:
    *source = "1.04 D2, within Guelich's distance of the tongue";
    return 1.04 * d2;
  case CW_CORRELATED_INLET_WIDTH:
    *source = "Guelich: b3/b2 from 2 at low to 1.05 at high nq: 1.6 - 0.75 nq/100";
    return d->outlet_width + fmax(LEAST_WIDENING * d2, d->outlet_width * fmax(0.15, 0.6 - 0.75 * nq / 100));
  default:
    *source = "";
    return NAN;
  }
}

// Guan's coefficient of the blade thickness for cast iron, over ns; as commonly quoted, not held against the book.
static double guan_thickness(double ns) {
  static const double table[][2] = {{40, 3.2}, {60, 3.5}, {70, 3.8}, {80, 4}, {90, 4.5}, {130, 6}, {190, 7}, {280, 10}};
  const int count = sizeof table / sizeof *table;
  int i = 1;
  while (i < count - 1 && ns > table[i][0]) i++;
  const double f = fmin(1, fmax(0, (ns - table[i - 1][0]) / (table[i][0] - table[i - 1][0])));
  return table[i - 1][1] + f * (table[i][1] - table[i - 1][1]);
}

static double guan(CwCorrelated quantity, const CwDesign *d, const char **source) {
  const double ns = d->specific_speed_ns, d2 = d->outlet_diameter, size = guan_size(d);
  switch (quantity) {
  case CW_CORRELATED_EFFICIENCY: {
    *source = "Guan: eta_h eta_v eta_m, eta_v = 1/(1 + 0.68 ns^(-2/3)), eta_m = 0.98 - 0.07 (ns/100)^(-7/6)";
    const double volumetric = 1 / (1 + 0.68 * pow(ns, -2.0 / 3));
    const double mechanical = 0.98 - 0.07 * pow(ns / 100, -7.0 / 6);
    return fmin(0.96, 1 + 0.0835 * log10(size)) * volumetric * mechanical;
  }
  case CW_CORRELATED_HYDRAULIC_EFFICIENCY:
    *source = "Guan: 1 + 0.0835 lg (Q/n)^(1/3), at most 0.96";
    return fmin(0.96, 1 + 0.0835 * log10(size));
  case CW_CORRELATED_SHAFT_DIAMETER:
    *source = "Guan: torsion, (1.2 M / (0.2 tau))^(1/3), tau = 35 MPa";
    return cbrt(1.2 * d->shaft_power / d->angular_speed / (0.2 * 35e6));
  case CW_CORRELATED_OUTLET_DIAMETER:
    *source = "Guan: 9.35 (ns/100)^-0.5 (Q/n)^(1/3)";
    return 9.35 / sqrt(ns / 100) * size;
  case CW_CORRELATED_HUB_DIAMETER:
    return hub(1.3 * d->shaft_diameter, d2, "Guan: 1.2 to 1.4 shaft diameters", source);
  case CW_CORRELATED_OUTLET_WIDTH:
    *source = "Guan: 0.64 (ns/100)^(5/6) (Q/n)^(1/3)";
    return 0.64 * pow(ns / 100, 5.0 / 6) * size;
  case CW_CORRELATED_INLET_DIAMETER:
    *source = "Guan: D0 = 4 (Q/n)^(1/3), D1^2 = D0^2 + dh^2";
    return hypot(4 * size, d->hub_diameter);
  case CW_CORRELATED_BLADE_COUNT:
    *source = "Guan: 8 under ns 45, 7 under 60, 6 under 120, 5 under 300";
    return ns < 45 ? 8 : ns < 60 ? 7 : ns < 120 ? 6 : 5;
  case CW_CORRELATED_BLADE_THICKNESS: {
    *source = "Guan: 1 mm + K D2 H^0.5 / z, K of cast iron; at least 3 mm or 0.02 D2";
    const double strength = (1 + guan_thickness(ns) * d2 * sqrt(d->water_head) / d->blade_count) * 1e-3;
    return fmax(strength, fmin(3e-3, 0.02 * d2));
  }
  case CW_CORRELATED_INCIDENCE:
    *source = "Guan: 3 to 10 deg";
    return 6 * CW_DEGREE;
  case CW_CORRELATED_BASE_DIAMETER:
    *source = "Guan: 1.03 to 1.08 D2";
    return 1.05 * d2;
  case CW_CORRELATED_INLET_WIDTH:
    *source = "Guan: b2 + 0.05 D2";
    return d->outlet_width + 0.05 * d2;
  default:
    *source = "";
    return NAN;
  }
}

double cw_correlation(CwCorrelations family, CwCorrelated quantity, const CwDesign *design, const char **source) {
  const char *unused;
  if (!source) source = &unused;
  return family == CW_CORRELATIONS_GUAN ? guan(quantity, design, source) : guelich(quantity, design, source);
}

int cw_correlated_quantity(CwCorrelated quantity) {
  static const int of[] = {
      [CW_CORRELATED_EFFICIENCY] = CW_DESIGN_efficiency,
      [CW_CORRELATED_HYDRAULIC_EFFICIENCY] = CW_DESIGN_hydraulic_efficiency,
      [CW_CORRELATED_SHAFT_DIAMETER] = CW_DESIGN_shaft_diameter,
      [CW_CORRELATED_OUTLET_DIAMETER] = CW_DESIGN_outlet_diameter,
      [CW_CORRELATED_HUB_DIAMETER] = CW_DESIGN_hub_diameter,
      [CW_CORRELATED_OUTLET_WIDTH] = CW_DESIGN_outlet_width,
      [CW_CORRELATED_INLET_DIAMETER] = CW_DESIGN_inlet_diameter,
      [CW_CORRELATED_BLADE_COUNT] = -1,
      [CW_CORRELATED_BLADE_THICKNESS] = CW_DESIGN_blade_thickness,
      [CW_CORRELATED_INCIDENCE] = CW_DESIGN_incidence,
      [CW_CORRELATED_BASE_DIAMETER] = CW_DESIGN_base_diameter,
      [CW_CORRELATED_INLET_WIDTH] = CW_DESIGN_inlet_width,
  };
  return of[quantity];
}
