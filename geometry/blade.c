// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/blade.h"

#include <math.h>
#include <string.h>

#include "pipeline/order.h"

static const double least_beta = 12 * M_PI / 180, largest_beta = 60 * M_PI / 180;
static const double offset_fades_at = 0.4;

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

// The section of the meridian at the points of Simpson's rule: it does not depend on the law, which is solved
// for.
enum { WRAP_STEPS = 50 };
typedef struct {
  double q[2 * WRAP_STEPS + 1], radius[2 * WRAP_STEPS + 1], speed[2 * WRAP_STEPS + 1];
} Samples;

static void sample(const CwMeridian *meridian, double span, Samples *samples) {
  for (int i = 0; i <= 2 * WRAP_STEPS; i++) {
    double x[2], dx[2];
    const double a = (double)(i / 2) / WRAP_STEPS, b = (double)(i / 2 + 1) / WRAP_STEPS;
    samples->q[i] = i % 2 ? 0.5 * (a + b) : a;
    cw_meridian_blade_point(meridian, span, samples->q[i], x, dx);
    samples->radius[i] = x[0];
    samples->speed[i] = hypot(dx[0], dx[1]);
  }
}

static double sampled_wrap(const Samples *samples, const double beta[3]) {
  double rate[2 * WRAP_STEPS + 1], sum = 0;
  for (int i = 0; i <= 2 * WRAP_STEPS; i++)
    rate[i] = samples->speed[i] / (samples->radius[i] * tan(law(beta, samples->q[i])));
  for (int i = 0; i < WRAP_STEPS; i++) {
    const double a = (double)i / WRAP_STEPS, b = (double)(i + 1) / WRAP_STEPS;
    sum += (b - a) / 6 * (rate[2 * i] + 4 * rate[2 * i + 1] + rate[2 * i + 2]);
  }
  return sum;
}

double cw_blade_wrap(const CwMeridian *meridian, double span, const double beta[3]) {
  Samples samples;
  sample(meridian, span, &samples);
  return sampled_wrap(&samples, beta);
}

// Point of the meridian at p of the blade, with its derivative by p.
static void at(const CwBladeSection *section, double p, double x[2], double dx[2]) {
  const double length = 1 - section->start;
  cw_meridian_blade_point(section->meridian, section->span, section->start + length * p, x, dx);
  dx[0] *= length;
  dx[1] *= length;
}

// Place q of mid-span at which a cylindrical blade has the radius r, for r not before its leading edge.
static double master_place(const CwBladeSection *section, double r) {
  const int low = cw_interval_of(CW_BLADE_STEPS + 1, section->radius, r), high = low + 1;
  double q = (low + (r - section->radius[low]) / (section->radius[high] - section->radius[low])) / CW_BLADE_STEPS;
  for (int i = 0; i < 3; i++) {
    double x[2], dx[2];
    cw_meridian_blade_point(section->meridian, 0.5, q, x, dx);
    q -= (x[0] - r) / dx[0];
  }
  return q;
}

// tan of the angle of a cylindrical blade in plan, from the tangential direction, at q of mid-span.
static double plan_tangent(const CwBladeSection *section, double q) {
  double x[2], dx[2];
  cw_meridian_blade_point(section->meridian, 0.5, q, x, dx);
  return tan(law(section->beta, q)) * dx[0] / hypot(dx[0], dx[1]);
}

static double mean_theta(const CwBladeSection *section, double q) {
  int i = (int)(q * CW_BLADE_STEPS);
  i = i < 0 ? 0 : i >= CW_BLADE_STEPS ? CW_BLADE_STEPS - 1 : i;
  const double begin = (double)i / CW_BLADE_STEPS, span = section->form == CW_BLADE_CYLINDRICAL ? 0.5 : section->span;
  return section->theta[i] - (q > begin ? wrap_step(section->meridian, span, section->beta, begin, q) : 0);
}

double cw_blade_beta(const CwBladeSection *section, double p) {
  const double q = section->start + (1 - section->start) * p;
  if (section->form != CW_BLADE_CYLINDRICAL) return law(section->beta, q);
  double x[2], dx[2];
  cw_meridian_blade_point(section->meridian, section->span, q, x, dx);
  return atan(plan_tangent(section, x[0] > section->radius[0] ? master_place(section, x[0]) : 0) * hypot(dx[0], dx[1]) /
              dx[0]);
}

double cw_blade_theta(const CwBladeSection *section, double p) {
  const double q = section->start + (1 - section->start) * p;
  if (section->form != CW_BLADE_CYLINDRICAL) return mean_theta(section, q) + section->shift;
  double x[2];
  cw_meridian_blade_point(section->meridian, section->span, q, x, NULL);
  if (x[0] > section->radius[0]) return mean_theta(section, master_place(section, x[0])) + section->shift;
  // Before the leading edge of mid-span the blade goes on as a logarithmic spiral.
  return section->theta[0] + log(section->radius[0] / x[0]) / plan_tangent(section, 0) + section->shift;
}

// The blade angles at both ends and the free ordinate that closes the wrap. Returns whether beta stays in
// range.
static int close_law(const CwDesign *design, const CwMeridian *meridian, double span, double wrap, double beta[3],
                     double range[2]) {
  double x[2], middle[2];
  cw_meridian_blade_point(meridian, 0.5, 0, middle, NULL);
  cw_meridian_blade_point(meridian, span, 0, x, NULL);
  // The inlet triangle with uniform c_m: tan beta1 falls as 1/r from hub to shroud.
  beta[0] = atan(tan(design->inlet_blade_angle) * middle[0] / x[0]);
  beta[2] = design->outlet_blade_angle;
  Samples samples;
  sample(meridian, span, &samples);
  double low = 1 * CW_DEGREE, high = 89 * CW_DEGREE;
  for (int i = 0; i < 60; i++) {
    beta[1] = 0.5 * (low + high);
    *(sampled_wrap(&samples, beta) > wrap ? &low : &high) = beta[1];
  }
  range[0] = range[1] = beta[0];
  for (int i = 1; i <= 100; i++) {
    const double b = law(beta, i / 100.0);
    range[0] = fmin(range[0], b);
    range[1] = fmax(range[1], b);
  }
  return range[0] >= least_beta && range[1] <= largest_beta && fabs(beta[1] - 45 * CW_DEGREE) < 43.9 * CW_DEGREE;
}

static int given_outside(const CwDesign *design, CwDesignQuantity quantity, double beta) {
  return (beta < least_beta || beta > largest_beta) && !strcmp(design->source[quantity], "case");
}

// What brings the angles of a law into their range. No wrap does where a given angle lies outside.
static const char *law_remedy(const CwDesign *design, const double beta[3], const double range[2]) {
  return given_outside(design, CW_DESIGN_outlet_blade_angle, beta[2]) ? "change outlet_blade_angle_deg"
         : given_outside(design, CW_DESIGN_inlet_blade_angle, beta[0])
             ? "change inlet_blade_angle_deg or move the leading edge radii"
         : range[1] > largest_beta ? "raise wrap_angle_deg or move the leading edge radii"
                                   : "lower wrap_angle_deg or move the leading edge radii";
}

// Where the ellipse of the leading edge ends.
static double nose_of(const CwDesign *design, const CwBladeSection *section) {
  double x[2], dx[2];
  at(section, 0, x, dx);
  return design->leading_edge_ratio * section->half_leading * sin(cw_blade_beta(section, 0)) / hypot(dx[0], dx[1]);
}

CwStatus cw_blade_section(const CwDesign *design, const CwMeridian *meridian, double span, CwBladeSection *section) {
  CwStatus status = CW_OK;
  double x[2], dx[2], beta[3], range[2];
  const double place = design->blade_form == CW_BLADE_CYLINDRICAL ? 0.5 : span;
  const double wrap = design->wrap_angle + (place - 0.5) * design->wrap_spread;
  CW_REQUIRE(close_law(design, meridian, place, wrap, beta, range), CW_ERR_DESIGN,
             "a wrap of %.2f deg with beta1 %.2f and beta2 %.2f deg asks for blade angles of %.2f to %.2f "
             "deg at span "
             "%.2f; 12 to 60 deg are allowed: %s",
             wrap / CW_DEGREE, beta[0] / CW_DEGREE, beta[2] / CW_DEGREE, range[0] / CW_DEGREE, range[1] / CW_DEGREE,
             place, law_remedy(design, beta, range));
  *section = (CwBladeSection){.meridian = meridian, .span = span, .form = design->blade_form};
  for (int i = 0; i < 3; i++) section->beta[i] = beta[i];
  section->theta[CW_BLADE_STEPS] = 0;
  for (int i = CW_BLADE_STEPS; i-- > 0;)
    section->theta[i] = section->theta[i + 1] +
                        wrap_step(meridian, place, beta, (double)i / CW_BLADE_STEPS, (double)(i + 1) / CW_BLADE_STEPS);
  for (int i = 0; design->blade_form == CW_BLADE_CYLINDRICAL && i <= CW_BLADE_STEPS; i++) {
    cw_meridian_blade_point(meridian, 0.5, (double)i / CW_BLADE_STEPS, x, NULL);
    section->radius[i] = x[0];
  }
  section->shift = (span - 0.5) * design->outlet_width * tan(design->lean_angle) / (design->outlet_diameter / 2);
  section->half_leading = design->leading_edge_thickness / 2;
  section->half_largest = design->blade_thickness / 2;
  section->half_trailing = design->trailing_edge_thickness / 2;
  section->thickest_at = design->thickest_at;
  section->end = 1;
  section->nose = nose_of(design, section);
  if (design->trailing_edge == CW_EDGE_ROUNDED) {
    // A half circle whose foremost point lies on D2.
    const double end_angle = cw_blade_beta(section, 1);
    at(section, 1, x, dx);
    const double radius = section->half_trailing / hypot(dx[0], dx[1]);
    section->trailing_nose = radius * sin(end_angle);
    section->end = 1 - radius; // hypot(sin, cos) of the angle
  }
done:
  return status;
}

CwStatus cw_blade_seams(const CwDesign *design, const CwMeridian *meridian, CwBladeSeams *seams) {
  enum { PARTS_MOST = 4 };
  CwStatus status = CW_OK;
  const double pitch = 2 * M_PI / design->blade_count, turned = 0.2; // of a part: how far its seam turns at the eye
  double last = 0;
  for (int j = 0; j < CW_SPAN_POINTS; j++) {
    CwBladeSection section;
    CW_TRY(cw_blade_section(design, meridian, (double)j / (CW_SPAN_POINTS - 1), &section));
    last = fmax(last, cw_blade_theta(&section, 0));
    if (design->splitter_start == 0) continue;
    section = cw_blade_splitter(design, &section);
    last = fmax(last, cw_blade_theta(&section, 0));
  }
  *seams = (CwBladeSeams){1, last, last + pitch};
  while (seams->reach > CW_SEAM_REACH_MOST && design->splitter_start == 0 && seams->parts < PARTS_MOST)
    seams->reach = last + pitch / ++seams->parts * (1 + turned);
done:
  return status;
}

double cw_blade_longest_nose(const CwBladeSection *section) {
  return fmin(0.5 * section->end, 0.8 * section->thickest_at);
}

CwBladeSection cw_blade_splitter(const CwDesign *design, const CwBladeSection *blade) {
  CwBladeSection section = *blade;
  section.start = design->splitter_start;
  section.shift += design->splitter_position * 2 * M_PI / design->blade_count;
  section.nose = nose_of(design, &section);
  section.end = 1 - (1 - blade->end) / (1 - section.start);
  section.trailing_nose = blade->trailing_nose / (1 - section.start);
  return section;
}

CwStatus cw_blade_wall_angle(const CwDesign *design, const CwMeridian *meridian, double *least) {
  enum { POINTS = 20 };
  CwStatus status = CW_OK;
  const double apart = 0.05;
  CwBladeSection on, off;
  *least = M_PI / 2;
  for (int wall = 0; wall < 2; wall++) {
    const double span = wall, other = wall ? 1 - apart : apart;
    CW_TRY(cw_blade_section(design, meridian, span, &on));
    CW_TRY(cw_blade_section(design, meridian, other, &off));
    for (int i = 0; i <= POINTS; i++) {
      const double p = (double)i / POINTS;
      double x[2], dx[2], y[2];
      cw_meridian_blade_point(meridian, span, p, x, dx);
      cw_meridian_blade_point(meridian, other, p, y, NULL);
      // Along the foot (m, theta) and across the span (along and normal to the wall in the meridian, theta).
      const double speed = hypot(dx[0], dx[1]), beta = cw_blade_beta(&on, p), c = cos(beta), s = sin(beta);
      const double along = ((y[0] - x[0]) * dx[0] + (y[1] - x[1]) * dx[1]) / speed;
      const double normal = ((y[0] - x[0]) * dx[1] - (y[1] - x[1]) * dx[0]) / speed;
      const double turned = x[0] * (cw_blade_theta(&off, p) - cw_blade_theta(&on, p));
      // Part of the span's direction square to the foot but along the wall. Round the nose, all that points upstream.
      const int upstream = i == 0 && along * s < turned * c;
      *least = fmin(*least, atan2(fabs(normal), upstream ? hypot(along, turned) : fabs(along * c + turned * s)));
    }
  }
done:
  return status;
}

// Least clear width between the pressure side of a section and the suction side of the next, whose theta is greater by
// `turn`: at equal q, square to the blade. Negative where they overlap.
static double clearance(const CwBladeSection *from, const CwBladeSection *next, double turn) {
  enum { POINTS = 100 };
  CwBladePoint a[POINTS + 1], b[POINTS + 1];
  double least = HUGE_VAL;
  for (int i = 0; i <= POINTS; i++) {
    const double f = (double)i / POINTS;
    a[i] = cw_blade_side(from, CW_BLADE_PRESSURE, from->nose + f * (from->end - from->nose));
    b[i] = cw_blade_side(next, CW_BLADE_SUCTION, next->nose + f * (next->end - next->nose));
  }
  for (int i = 0, j = 0; i <= POINTS; i++) {
    while (j < POINTS - 1 && b[j + 1].q < a[i].q) j++;
    const double share = (a[i].q - b[j].q) / (b[j + 1].q - b[j].q);
    if (share < 0 || share > 1) continue;
    const double theta = b[j].theta + share * (b[j + 1].theta - b[j].theta) + turn;
    const double p = (a[i].q - from->start) / (1 - from->start), beta = cw_blade_beta(from, fmin(1, fmax(0, p)));
    double x[2];
    cw_meridian_blade_point(from->meridian, from->span, a[i].q, x, NULL);
    least = fmin(least, (theta - a[i].theta) * x[0] * sin(beta));
  }
  return least;
}

CwStatus cw_blade_clearance(const CwDesign *design, const CwMeridian *meridian, double *least) {
  CwStatus status = CW_OK;
  const double pitch = 2 * M_PI / design->blade_count;
  *least = HUGE_VAL;
  for (int wall = 0; wall < 2; wall++) {
    CwBladeSection blade;
    CW_TRY(cw_blade_section(design, meridian, wall, &blade));
    if (design->splitter_start > 0) {
      const CwBladeSection splitter = cw_blade_splitter(design, &blade);
      *least = fmin(*least, clearance(&blade, &splitter, 0));
      *least = fmin(*least, clearance(&splitter, &blade, pitch));
    } else {
      *least = fmin(*least, clearance(&blade, &blade, pitch));
    }
  }
done:
  return status;
}

double cw_blade_half_thickness(const CwBladeSection *section, double p) {
  const double top = section->thickest_at;
  if (p < top)
    return section->half_leading + (section->half_largest - section->half_leading) *
                                       cw_smooth_step((p - section->nose) / (top - section->nose));
  return section->half_largest +
         (section->half_trailing - section->half_largest) * cw_smooth_step((p - top) / (section->end - top));
}

// Offset by y (positive: towards greater theta). lambda = 1 at the leading edge is the true normal offset,
// which makes a round nose; lambda = 0 from p = 0.4 on is a tangential offset, which keeps a cut trailing
// edge on D2. A blade with a rounded trailing edge has the normal offset all along: between the two offsets a thick
// blade's sides would bend to and fro.
static CwBladePoint offset(const CwBladeSection *section, double p, double y) {
  const double lambda = section->end < 1 ? 1 : 1 - cw_smooth_step(p / offset_fades_at);
  const double beta = cw_blade_beta(section, p), c = cos(beta), s = sin(beta);
  double x[2], dx[2];
  at(section, p, x, dx);
  const double along = p + lambda * y * c / hypot(dx[0], dx[1]);
  CwBladePoint point = {section->start + (1 - section->start) * along,
                        cw_blade_theta(section, p) + y * (1 - lambda * c * c) / (s * x[0])};
  return point;
}

CwBladePoint cw_blade_side(const CwBladeSection *section, CwBladeSide side, double p) {
  const double y = cw_blade_half_thickness(section, p);
  return offset(section, p, side == CW_BLADE_PRESSURE ? y : -y);
}

CwBladePoint cw_blade_leading_edge(const CwBladeSection *section, double psi) {
  return offset(section, section->nose * (1 - cos(psi)), section->half_leading * sin(psi));
}

CwBladePoint cw_blade_trailing_edge(const CwBladeSection *section, double psi) {
  return offset(section, section->end + section->trailing_nose * cos(psi), section->half_trailing * sin(psi));
}

// Length of the cut on D2 of a blunt trailing edge.
static double cut_length(double thickness, double angle) {
  return thickness / sin(angle);
}

double cw_blade_usual_bevel(CwTrailingEdge edge, double thickness, double angle) {
  const double cut = cut_length(thickness, angle);
  if (edge == CW_EDGE_SHARP) return cut * sqrt(5 - 4 * cos(angle));
  // With legs l the facet is 2 l sin(beta/2) and the rest of the cut e / sin beta - l.
  const double chord = 2 * sin(angle / 2);
  return cut * chord / (1 + chord);
}

// Length along the suction side that a leg of one unit takes, in p.
static double leg_in_p(const CwBladeSection *section) {
  double x[2], dx[2];
  at(section, 1, x, dx);
  return sin(cw_blade_beta(section, 1)) / hypot(dx[0], dx[1]);
}

double cw_blade_bevel_begin(const CwBladeSection *section, CwTrailingEdge edge, double facet) {
  const double beta = cw_blade_beta(section, 1);
  double leg = facet / (2 * sin(beta / 2));
  if (edge == CW_EDGE_SHARP) {
    const double cut = cut_length(2 * section->half_trailing, beta), height = cut * sin(beta);
    leg = cut * cos(beta) + sqrt(fmax(0, facet * facet - height * height));
  }
  return 1 - leg * leg_in_p(section);
}

double cw_blade_bevel_earliest(CwTrailingEdge edge) {
  return edge == CW_EDGE_SHARP ? 0.7 : 0.8;
}

double cw_blade_longest_bevel(const CwBladeSection *section, CwTrailingEdge edge) {
  const double margin = 0.99, beta = cw_blade_beta(section, 1);
  const double leg = margin * (1 - cw_blade_bevel_earliest(edge)) / leg_in_p(section);
  if (edge != CW_EDGE_SHARP) return 2 * leg * sin(beta / 2);
  const double cut = cut_length(2 * section->half_trailing, beta);
  return hypot(cut * sin(beta), leg - cut * cos(beta));
}

double cw_blade_bevel_theta(const CwBladeSection *section, double p_begin) {
  const CwBladePoint corner = cw_blade_side(section, CW_BLADE_SUCTION, 1);
  const CwBladePoint begin = cw_blade_side(section, CW_BLADE_SUCTION, p_begin);
  double x[2], dx[2];
  at(section, 1, x, dx);
  const double dm = (1 - p_begin) * hypot(dx[0], dx[1]), across = (begin.theta - corner.theta) * x[0];
  return corner.theta + hypot(dm, across) / x[0];
}
