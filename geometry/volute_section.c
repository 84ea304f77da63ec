// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/volute_section.h"

#include <math.h>

#include "geometry/root.h"

int cw_volute_has_corners(const CwVolute *volute) {
  return !isnan(volute->input.corner_radius);
}

double cw_volute_half_width(const CwVolute *volute, double r) {
  return 0.5 * volute->input.inlet_width + (r - cw_volute_base_radius(volute)) * tan(volute->input.side_wall_angle);
}

// Integral of b dr / r over a trapezoid from r3 to r_o.
static double trapezoid_integral(double r3, double b3, double slope, double r_o) {
  return (b3 - 2 * r3 * slope) * log(r_o / r3) + 2 * slope * (r_o - r3);
}

typedef struct {
  double r3, b3, slope, q;
} Trapezoid;

static double trapezoid_excess(double height, const void *context) {
  const Trapezoid *t = context;
  return trapezoid_integral(t->r3, t->b3, t->slope, t->r3 + height) - t->q;
}

double cw_volute_trapezoid_height(double r3, double b3, double side_wall_angle, double q) {
  Trapezoid t = {r3, b3, tan(side_wall_angle), q};
  return cw_root_find(trapezoid_excess, &t, 0, 10 * r3);
}

// Half angle k of the arcs at phi, and its derivative: constant up to the tongue, then by the polynomial
// whose first two derivatives vanish at both ends.
static double arc_angle(const CwVolute *volute, double phi, double *slope) {
  double k = volute->arc_half_angle, change = volute->end_half_angle - k;
  double span = 2 * CW_VOLUTE_SECTOR, s = fmin(fmax((phi - volute->start_angle) / span, 0), 1);
  *slope = change * 30 * s * s * (1 - s) * (1 - s) / span;
  return k + change * s * s * s * (10 + s * (6 * s - 15));
}

// The section with the arcs' half angle k whose kink lies at r_k; without slopes.
static CwVoluteSection section_at(const CwVolute *volute, double r_k, double k) {
  double r3 = cw_volute_base_radius(volute), b3 = volute->input.inlet_width;
  CwVoluteSection s = {.kink_radius = r_k, .kink_height = cw_volute_half_width(volute, r_k), .arc_angle = k};
  s.arc_radius = s.kink_height / sin(k);
  if (cw_volute_has_corners(volute)) {
    s.arc_radius = volute->input.corner_radius;
    s.flat = s.kink_height - s.arc_radius * sin(k);
  }
  s.arc_centre = r_k - s.arc_radius * cos(k);
  s.outer_radius = s.arc_centre + s.arc_radius;
  double c = s.arc_centre, rho = s.arc_radius;
  s.area =
      (0.5 * b3 + s.kink_height) * (r_k - r3) + rho * rho * (k - sin(k) * cos(k)) + 2 * s.flat * (s.outer_radius - r_k);
  // Integral of rho^2 sin^2 psi / (c + rho cos psi) over 0..k, in closed form on either side of c = rho.
  double d = (c - rho) * (c + rho), t = tan(k / 2) * sqrt(fabs((c - rho) / (c + rho)));
  double arc = c * k - rho * sin(k) + 2 * sqrt(fabs(d)) * (d > 0 ? -atan(t) : atanh(t));
  s.integral = trapezoid_integral(r3, b3, tan(volute->input.side_wall_angle), r_k) + 2 * arc +
               2 * s.flat * log(s.outer_radius / r_k);
  return s;
}

double cw_volute_law(const CwVolute *volute, double r_k, double k) {
  CwVoluteSection s = section_at(volute, r_k, k);
  return volute->input.area_law == CW_AREA_LAW_VELOCITY ? s.area : s.integral;
}

typedef struct {
  const CwVolute *volute;
  double arc_angle, value; // what the law is to reach
} Law;

static double law_excess(double r_k, const void *context) {
  const Law *law = context;
  return cw_volute_law(law->volute, r_k, law->arc_angle) - law->value;
}

CwVoluteSection cw_volute_section(const CwVolute *volute, double phi) {
  double growth = (volute->law_end - volute->law_start) / (2 * M_PI), r3 = cw_volute_base_radius(volute), k_slope;
  double k = arc_angle(volute, phi, &k_slope);
  Law law = {volute, k, fmax(cw_volute_law(volute, r3, k), volute->law_start + growth * phi)};
  double r_k = cw_root_find(law_excess, &law, r3, 3 * r3);
  CwVoluteSection s = section_at(volute, r_k, k);
  double step = 1e-4 * r3;
  double slope = (cw_volute_law(volute, r_k + step, k) - cw_volute_law(volute, r_k - step, k)) / (2 * step);
  if (k_slope != 0)
    growth -= k_slope * (cw_volute_law(volute, r_k, k + 1e-4) - cw_volute_law(volute, r_k, k - 1e-4)) / 2e-4;
  s.kink_slope = growth / slope;
  s.arc_angle_slope = k_slope;
  return s;
}

double cw_volute_wall_radius(const CwVoluteSection *section, double z) {
  double above = fmax(0, fabs(z) - section->flat);
  return section->arc_centre + sqrt(section->arc_radius * section->arc_radius - above * above);
}

void cw_volute_wall_point(const CwVolute *volute, double phi, double psi, double x[3], double x_phi[3],
                          double x_psi[3]) {
  CwVoluteSection s = cw_volute_section(volute, phi);
  double k = s.arc_angle, k_phi = s.arc_angle_slope, ratio = k / volute->arc_half_angle, rho = s.arc_radius;
  double height_phi = s.kink_slope * tan(volute->input.side_wall_angle), rho_phi = 0, alpha = psi * ratio;
  // Radius and level, and their derivatives; alpha is the normal's angle.
  double r, z, r_phi, z_phi, r_psi, z_psi;
  if (!cw_volute_has_corners(volute)) {
    double alpha_phi = psi * k_phi / volute->arc_half_angle;
    rho_phi = height_phi / sin(k) - rho * cos(k) / sin(k) * k_phi;
    double centre_phi = s.kink_slope - rho_phi * cos(k) + rho * sin(k) * k_phi;
    r = s.arc_centre + rho * cos(alpha);
    z = rho * sin(alpha);
    r_phi = centre_phi + rho_phi * cos(alpha) - rho * sin(alpha) * alpha_phi;
    z_phi = rho_phi * sin(alpha) + rho * cos(alpha) * alpha_phi;
    r_psi = -rho * sin(alpha) * ratio;
    z_psi = rho * cos(alpha) * ratio;
  } else {
    // By the share t of the length, first along the straight wall, then round the corner.
    double t = fabs(psi) / volute->arc_half_angle, length = s.flat + rho * k, side = psi < 0 ? -1 : 1;
    double flat_phi = height_phi - rho * cos(k) * k_phi, length_phi = flat_phi + rho * k_phi;
    double flat = fmin(t * length, s.flat), alpha_phi = 0;
    alpha = (t * length - flat) / rho;
    z_phi = t * length_phi;
    if (alpha > 0) {
      alpha_phi = (t * length_phi - flat_phi) / rho;
      z_phi = flat_phi + rho * cos(alpha) * alpha_phi;
    }
    r = s.arc_centre + rho * cos(alpha);
    z = side * (flat + rho * sin(alpha));
    r_phi = s.kink_slope + rho * sin(k) * k_phi - rho * sin(alpha) * alpha_phi;
    z_phi *= side;
    r_psi = -side * sin(alpha) * length / volute->arc_half_angle;
    z_psi = cos(alpha) * length / volute->arc_half_angle;
  }
  x[0] = r * cos(phi);
  x[1] = r * sin(phi);
  x[2] = z;
  if (x_phi) {
    x_phi[0] = r_phi * cos(phi) - r * sin(phi);
    x_phi[1] = r_phi * sin(phi) + r * cos(phi);
    x_phi[2] = z_phi;
  }
  if (x_psi) {
    x_psi[0] = r_psi * cos(phi);
    x_psi[1] = r_psi * sin(phi);
    x_psi[2] = z_psi;
  }
}

double cw_volute_section_parameter(const CwVolute *volute, const CwVoluteSection *s, double w) {
  double alpha = asin(fmin(fmax(0, w - s->flat) / s->arc_radius, 1));
  if (!cw_volute_has_corners(volute)) return alpha / (s->arc_angle / volute->arc_half_angle);
  return volute->arc_half_angle * (fmin(w, s->flat) + s->arc_radius * alpha) / (s->flat + s->arc_radius * s->arc_angle);
}
