// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/blade.h"

#include <math.h>

static const double degree = M_PI / 180;
static const double least_beta = 12 * M_PI / 180, largest_beta = 60 * M_PI / 180;
static const double thickest_at = 0.45; // q of the largest thickness
static const double offset_fades_at = 0.4;
static const double nose_ratio = 2; // semi-axes of the leading edge ellipse

static double law(const double beta[3], double q) {
  return (1 - q) * (1 - q) * beta[0] + 2 * q * (1 - q) * beta[1] + q * q * beta[2];
}

static double wrap_rate(const CwMeridian *meridian, double span, const double beta[3], double q) {
  double x[2], dx[2];
  cw_meridian_blade_point(meridian, span, q, x, dx);
  return hypot(dx[0], dx[1]) / (x[0] * tan(law(beta, q)));
}

// Simpson on one step.
static double wrap_step(const CwMeridian *meridian, double span, const double beta[3], double a, double b) {
  return (b - a) / 6 *
         (wrap_rate(meridian, span, beta, a) + 4 * wrap_rate(meridian, span, beta, 0.5 * (a + b)) +
          wrap_rate(meridian, span, beta, b));
}

double cw_blade_wrap(const CwMeridian *meridian, double span, const double beta[3]) {
  enum { STEPS = 50 };
  double sum = 0;
  for (int i = 0; i < STEPS; i++)
    sum += wrap_step(meridian, span, beta, (double)i / STEPS, (double)(i + 1) / STEPS);
  return sum;
}

// Fifth-degree step from 0 to 1, flat to the second order at both ends.
static double smooth_step(double x) {
  x = x < 0 ? 0 : x > 1 ? 1 : x;
  return x * x * x * (10 - 15 * x + 6 * x * x);
}

CwStatus cw_blade_section(const CwDesign *design, const CwMeridian *meridian, double span,
                          CwBladeSection *section) {
  CwStatus status = CW_OK;
  double x[2], dx[2], middle[2];
  const double wrap = design->wrap_angle;
  cw_meridian_blade_point(meridian, 0.5, 0, middle, NULL);
  cw_meridian_blade_point(meridian, span, 0, x, dx);
  // The inlet triangle with uniform c_m: tan beta1 falls as 1/r from hub to shroud.
  double beta[3] = {atan(tan(design->inlet_blade_angle) * middle[0] / x[0]), 0, design->outlet_blade_angle};
  double low = 1 * degree, high = 89 * degree;
  for (int i = 0; i < 60; i++) {
    beta[1] = 0.5 * (low + high);
    if (cw_blade_wrap(meridian, span, beta) > wrap)
      low = beta[1];
    else
      high = beta[1];
  }
  double least = beta[0], largest = beta[0];
  for (int i = 1; i <= 100; i++) {
    const double b = law(beta, i / 100.0);
    least = fmin(least, b);
    largest = fmax(largest, b);
  }
  CW_REQUIRE(least >= least_beta && largest <= largest_beta && high - low < degree, CW_ERR_DESIGN,
             "a wrap of %.2f deg with beta1 %.2f and beta2 %.2f deg asks for blade angles of %.2f to %.2f "
             "deg at span "
             "%.2f; 12 to 60 deg are allowed: change the wrap or the leading edge radii",
             wrap / degree, beta[0] / degree, beta[2] / degree, least / degree, largest / degree, span);
  section->meridian = meridian;
  section->span = span;
  for (int i = 0; i < 3; i++)
    section->beta[i] = beta[i];
  section->theta[CW_BLADE_STEPS] = 0;
  for (int i = CW_BLADE_STEPS; i-- > 0;)
    section->theta[i] = section->theta[i + 1] + wrap_step(meridian, span, beta, (double)i / CW_BLADE_STEPS,
                                                          (double)(i + 1) / CW_BLADE_STEPS);
  section->half_leading = design->leading_edge_thickness / 2;
  section->half_largest = design->blade_thickness / 2;
  section->half_trailing = design->trailing_edge_thickness / 2;
  section->nose = nose_ratio * section->half_leading * sin(beta[0]) / hypot(dx[0], dx[1]);
done:
  return status;
}

double cw_blade_beta(const CwBladeSection *section, double q) {
  return law(section->beta, q);
}

double cw_blade_theta(const CwBladeSection *section, double q) {
  int i = (int)(q * CW_BLADE_STEPS);
  i = i < 0 ? 0 : i >= CW_BLADE_STEPS ? CW_BLADE_STEPS - 1 : i;
  const double begin = (double)i / CW_BLADE_STEPS;
  return section->theta[i] -
         (q > begin ? wrap_step(section->meridian, section->span, section->beta, begin, q) : 0);
}

double cw_blade_half_thickness(const CwBladeSection *section, double q) {
  if (q < thickest_at)
    return section->half_leading + (section->half_largest - section->half_leading) *
                                       smooth_step((q - section->nose) / (thickest_at - section->nose));
  return section->half_largest + (section->half_trailing - section->half_largest) *
                                     smooth_step((q - thickest_at) / (1 - thickest_at));
}

// Offset by y (positive: towards greater theta). lambda = 1 at the leading edge is the true normal offset,
// which makes a round nose; lambda = 0 from q = 0.4 on is a tangential offset, which keeps the trailing edge
// on D2.
static CwBladePoint offset(const CwBladeSection *section, double q, double y) {
  const double lambda = 1 - smooth_step(q / offset_fades_at), beta = law(section->beta, q);
  const double c = cos(beta), s = sin(beta);
  double x[2], dx[2];
  cw_meridian_blade_point(section->meridian, section->span, q, x, dx);
  CwBladePoint point = {q + lambda * y * c / hypot(dx[0], dx[1]),
                        cw_blade_theta(section, q) + y * (1 - lambda * c * c) / (s * x[0])};
  return point;
}

CwBladePoint cw_blade_side(const CwBladeSection *section, CwBladeSide side, double q) {
  const double y = cw_blade_half_thickness(section, q);
  return offset(section, q, side == CW_BLADE_PRESSURE ? y : -y);
}

CwBladePoint cw_blade_leading_edge(const CwBladeSection *section, double psi) {
  return offset(section, section->nose * (1 - cos(psi)), section->half_leading * sin(psi));
}

double cw_blade_balanced_bevel(double trailing_edge_thickness, double outlet_blade_angle) {
  // The cut is e / sin beta long; with legs l the facet is 2 l sin(beta/2) and the rest of the cut e / sin
  // beta - l.
  const double cut = trailing_edge_thickness / sin(outlet_blade_angle),
               chord = 2 * sin(outlet_blade_angle / 2);
  return cut * chord / (1 + chord);
}

double cw_blade_bevel_begin(const CwBladeSection *section, double facet) {
  const double beta = law(section->beta, 1);
  double x[2], dx[2];
  cw_meridian_blade_point(section->meridian, section->span, 1, x, dx);
  return 1 - facet / (2 * sin(beta / 2)) * sin(beta) / hypot(dx[0], dx[1]);
}

double cw_blade_bevel_theta(const CwBladeSection *section, double q_begin) {
  const CwBladePoint corner = cw_blade_side(section, CW_BLADE_SUCTION, 1);
  const CwBladePoint begin = cw_blade_side(section, CW_BLADE_SUCTION, q_begin);
  double x[2], dx[2];
  cw_meridian_blade_point(section->meridian, section->span, 1, x, dx);
  const double dm = (1 - q_begin) * hypot(dx[0], dx[1]), across = (begin.theta - corner.theta) * x[0];
  return corner.theta + hypot(dm, across) / x[0];
}
