// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/volute_design.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

// The spiral begins this share of D3/2 outside it: a section that begins at nothing has no outer wall.
static const double START_MARGIN = 0.003;
// The kink at the end of the spiral lies within so many D3/2: enough for nq 60 or so.
static const double LARGEST_SPIRAL = 2.5;
// Half angle of the outer arc at the tongue. A larger one sweeps the nose back more: with 60 degrees it leans so far that
// its edge to the flank has a radius of 0.05 mm (0.4 mm with 35); a smaller one sharpens the kink between
// outer and side walls (105 degrees with 35 and side walls at 20).
static const double ARC_HALF_ANGLE = 35 * PI / 180;
// Angle of the kink line to the tongue's flank where the nose begins, by default and at its limits. The
// smaller it is, the further the nose lies along the side walls, and the sharper are the corners of the faces
// there.
static const double DEFAULT_WEDGE = 26 * PI / 180, LEAST_WEDGE = 15 * PI / 180, LARGEST_WEDGE = 42 * PI / 180;
// The throat lies this many nose radii behind the centre of the nose, so that the flank is no needle.
static const double THROAT_SETBACK = 2.0;
// Above the kink's level the nose's centre line levels out over this height, in nose radii.
static const double LEVEL_OUT = 1.0;

typedef double (*Function)(double x, const void *context);

// Root of f in [a, b] by false position with the Illinois rule; NAN where f has one sign at both ends.
static double find_root(Function f, const void *context, double a, double b) {
  double fa = f(a, context), fb = f(b, context);
  if (fa == 0)
    return a;
  if (fb == 0)
    return b;
  if (!(fa * fb < 0))
    return NAN;
  double x = a;
  for (int i = 0; i < 200; i++) {
    double next = b - fb * (b - a) / (fb - fa);
    if (i % 8 == 7)
      next = 0.5 * (a + b);
    double moved = fabs(next - x);
    x = next;
    double fx = f(x, context);
    if (fx == 0 || fabs(b - a) <= 4e-16 * (fabs(a) + fabs(b)) || (moved <= 1e-16 * fabs(x) && i % 8 != 7))
      break;
    if (fx * fb < 0) {
      a = b;
      fa = fb;
    } else {
      fa *= 0.5;
    }
    b = x;
    fb = fx;
  }
  return x;
}

static double base_radius(const CwVolute *volute) {
  return 0.5 * volute->input.base_diameter;
}

static int has_corners(const CwVolute *volute) {
  return !isnan(volute->input.corner_radius);
}

double cw_volute_half_width(const CwVolute *volute, double r) {
  return 0.5 * volute->input.inlet_width + (r - base_radius(volute)) * tan(volute->input.side_wall_angle);
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
  return find_root(trapezoid_excess, &t, 0, 10 * r3);
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
  double r3 = base_radius(volute), b3 = volute->input.inlet_width;
  CwVoluteSection s = {.kink_radius = r_k, .kink_height = cw_volute_half_width(volute, r_k), .arc_angle = k};
  s.arc_radius = s.kink_height / sin(k);
  if (has_corners(volute)) {
    s.arc_radius = volute->input.corner_radius;
    s.flat = s.kink_height - s.arc_radius * sin(k);
  }
  s.arc_centre = r_k - s.arc_radius * cos(k);
  s.outer_radius = s.arc_centre + s.arc_radius;
  double c = s.arc_centre, rho = s.arc_radius;
  s.area = (0.5 * b3 + s.kink_height) * (r_k - r3) + rho * rho * (k - sin(k) * cos(k)) +
           2 * s.flat * (s.outer_radius - r_k);
  // Integral of rho^2 sin^2 psi / (c + rho cos psi) over 0..k, in closed form on either side of c = rho.
  double d = (c - rho) * (c + rho), t = tan(k / 2) * sqrt(fabs((c - rho) / (c + rho)));
  double arc = c * k - rho * sin(k) + 2 * sqrt(fabs(d)) * (d > 0 ? -atan(t) : atanh(t));
  s.integral = trapezoid_integral(r3, b3, tan(volute->input.side_wall_angle), r_k) + 2 * arc +
               2 * s.flat * log(s.outer_radius / r_k);
  return s;
}

typedef struct {
  const CwVolute *volute;
  double value; // what the function is to reach
  double psi, level, beta, arc_angle;
} Context;

// What grows linearly with phi.
static double law_at(const CwVolute *volute, double r_k, double k) {
  CwVoluteSection s = section_at(volute, r_k, k);
  return volute->input.area_law == CW_AREA_LAW_VELOCITY ? s.area : s.integral;
}

static double law_excess(double r_k, const void *context) {
  const Context *c = context;
  return law_at(c->volute, r_k, c->arc_angle) - c->value;
}

CwVoluteSection cw_volute_section(const CwVolute *volute, double phi) {
  double growth = (volute->law_end - volute->law_start) / (2 * PI), r3 = base_radius(volute), k_slope;
  Context context = {.volute = volute, .value = volute->law_start + growth * phi};
  double k = context.arc_angle = arc_angle(volute, phi, &k_slope);
  double r_k = find_root(law_excess, &context, r3, 3 * r3);
  CwVoluteSection s = section_at(volute, r_k, k);
  double step = 1e-4 * r3;
  double slope = (law_at(volute, r_k + step, k) - law_at(volute, r_k - step, k)) / (2 * step);
  if (k_slope != 0)
    growth -= k_slope * (law_at(volute, r_k, k + 1e-4) - law_at(volute, r_k, k - 1e-4)) / 2e-4;
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
  if (!has_corners(volute)) {
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

// The contour's parameter at the level w >= 0; the arc goes on beyond the kink.
static double parameter_at(const CwVolute *volute, const CwVoluteSection *s, double w) {
  double alpha = asin(fmin(fmax(0, w - s->flat) / s->arc_radius, 1));
  if (!has_corners(volute))
    return alpha / (s->arc_angle / volute->arc_half_angle);
  return volute->arc_half_angle * (fmin(w, s->flat) + s->arc_radius * alpha) /
         (s->flat + s->arc_radius * s->arc_angle);
}

void cw_volute_contact_circle(const CwVolute *volute, double phi, double psi, double centre[2],
                              double normal[2]) {
  double x[3], a[3], b[3];
  cw_volute_wall_point(volute, phi, psi, x, a, b);
  // a x b points out of the fluid: phi runs with the flow, psi upward.
  double nx = a[1] * b[2] - a[2] * b[1], ny = a[2] * b[0] - a[0] * b[2], length = hypot(nx, ny);
  normal[0] = nx / length;
  normal[1] = ny / length;
  for (int i = 0; i < 2; i++)
    centre[i] = x[i] + volute->input.tongue_radius * normal[i];
}

static double contact_excess(double phi, const void *context) {
  const Context *c = context;
  double centre[2], normal[2];
  cw_volute_contact_circle(c->volute, phi, c->psi, centre, normal);
  return centre[0] + c->volute->input.tongue_radius - c->volute->inner_wall_x;
}

static double contact_at_level_excess(double phi, const void *context) {
  Context c = *(const Context *)context;
  CwVoluteSection section = cw_volute_section(c.volute, phi);
  c.psi = parameter_at(c.volute, &section, c.level);
  return contact_excess(phi, &c);
}

double cw_volute_contact_angle(const CwVolute *volute, double psi) {
  if (fabs(psi) >= volute->arc_half_angle)
    return volute->start_angle;
  Context context = {.volute = volute, .psi = fabs(psi)};
  return find_root(contact_excess, &context, volute->start_angle, 0.45 * PI);
}

double cw_volute_nose_y(const CwVolute *volute, double w) {
  w = fabs(w);
  double above = w - volute->side_level;
  if (above >= 0) {
    double scale = LEVEL_OUT * volute->input.tongue_radius;
    return volute->side_centre_y + volute->side_centre_slope * scale * (1 - exp(-above / scale));
  }
  Context context = {.volute = volute, .level = w};
  // A little past the tip's angle, where the root lies at w = 0.
  double phi = find_root(contact_at_level_excess, &context, volute->start_angle, volute->tip_angle + 1e-9);
  if (isnan(phi)) // along a wall parallel to the axis all levels touch at the tip's angle, but for rounding
    phi = find_root(contact_at_level_excess, &context, volute->start_angle - 1e-3, volute->tip_angle + 1e-3);
  CwVoluteSection section = cw_volute_section(volute, phi);
  double centre[2], normal[2];
  cw_volute_contact_circle(volute, phi, parameter_at(volute, &section, w), centre, normal);
  return centre[1];
}

static double nose_height_excess(double w, const void *context) {
  const Context *c = context;
  double radius = c->volute->input.tongue_radius;
  double x = c->volute->inner_wall_x - radius + radius * cos(c->beta);
  double y = cw_volute_nose_y(c->volute, w) + radius * sin(c->beta);
  return cw_volute_half_width(c->volute, hypot(x, y)) - w;
}

double cw_volute_nose_height(const CwVolute *volute, double beta) {
  Context context = {.volute = volute, .beta = beta};
  return find_root(nose_height_excess, &context, 0.8 * volute->side_level, 2 * volute->side_level);
}

static double throat_excess(double phi, const void *context) {
  const Context *c = context;
  double x[3];
  cw_volute_wall_point(c->volute, phi, c->psi, x, NULL, NULL);
  return x[1] - c->volute->throat_y;
}

double cw_volute_throat_angle(const CwVolute *volute, double psi) {
  Context context = {.volute = volute, .psi = psi};
  return find_root(throat_excess, &context, 2 * PI, 2.4 * PI);
}

// Area of the cut at y = y_t: 2 z dx along the side wall, then along the arc (Simpson's rule).
static double throat_area(const CwVolute *volute) {
  enum { COUNT = 64 };
  double k = volute->arc_half_angle, y = volute->throat_y, sum = 0, corner[3];
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, k), k, corner, NULL, NULL);
  double step = (corner[0] - volute->inner_wall_x) / COUNT;
  for (int i = 0; i <= COUNT; i++) {
    double weight = i == 0 || i == COUNT ? 1 : i % 2 ? 4 : 2;
    sum += weight * 2 * step / 3 * cw_volute_half_width(volute, hypot(volute->inner_wall_x + i * step, y));
  }
  const int count = has_corners(volute) ? 8 * COUNT : COUNT; // the contour's curvature jumps at its corners
  step = k / count;
  for (int i = 0; i <= count; i++) {
    double weight = i == 0 || i == count ? 1 : i % 2 ? 4 : 2;
    double psi = k - i * step, phi = cw_volute_throat_angle(volute, psi), x[3], x_phi[3], x_psi[3];
    cw_volute_wall_point(volute, phi, psi, x, x_phi, x_psi);
    double x_along = x_psi[0] - x_phi[0] * x_psi[1] / x_phi[1]; // dx/dpsi at constant y
    sum -= weight * 2 * step / 3 * x[2] * x_along;
  }
  return sum;
}

static double wedge_excess(double phi, const void *context) {
  const Context *c = context;
  CwVoluteSection s = cw_volute_section(c->volute, phi);
  return phi - atan(s.kink_slope / s.kink_radius) - c->value;
}

// Places the tongue where the kink line begins at the angle `wedge` to the flank: x_i, tip and throat.
static void place_tongue(CwVolute *volute, double wedge) {
  double centre[2], normal[2];
  Context context = {.volute = volute, .value = wedge};
  volute->start_angle = 2 * PI; // so that the arcs keep their angle at the tongue while it is looked for
  volute->start_angle = find_root(wedge_excess, &context, 0, 0.45 * PI);
  cw_volute_contact_circle(volute, volute->start_angle, volute->arc_half_angle, centre, normal);
  volute->inner_wall_x = centre[0] + volute->input.tongue_radius;
  volute->tip_angle = cw_volute_contact_angle(volute, 0);
  cw_volute_contact_circle(volute, volute->tip_angle, 0, centre, normal);
  volute->tip_radius = hypot(centre[0], centre[1]) - volute->input.tongue_radius;
  volute->throat_y = centre[1] + THROAT_SETBACK * volute->input.tongue_radius;
}

// What a tongue with the angle `wedge` has: its tip's angle or its gap.
static double tongue_at(double wedge, const CwVolute *volute) {
  CwVolute trial = *volute;
  place_tongue(&trial, wedge);
  return isnan(volute->input.tongue_angle) ? trial.tip_radius - base_radius(&trial) : trial.tip_angle;
}

static double tongue_excess(double wedge, const void *context) {
  const Context *c = context;
  return tongue_at(wedge, c->volute) - c->value;
}

// Throat area of a spiral that ends with `end`, less the asked one.
static double close_spiral(CwVolute *volute, double end) {
  const CwVoluteInput *in = &volute->input;
  volute->law_end = end;
  Context context = {.volute = volute, .value = isnan(in->tongue_angle) ? in->tongue_gap : in->tongue_angle};
  double wedge = DEFAULT_WEDGE;
  if (isnan(context.value) && tongue_at(wedge, volute) < in->least_tongue_gap)
    context.value = in->least_tongue_gap;
  if (!isnan(context.value)) {
    wedge = find_root(tongue_excess, &context, LEAST_WEDGE, LARGEST_WEDGE);
    if (isnan(wedge)) // the nearest tongue; where gap or angle is given, check_tongue() says what is allowed
      wedge = tongue_excess(LEAST_WEDGE, &context) > 0 ? LEAST_WEDGE : LARGEST_WEDGE;
  }
  place_tongue(volute, wedge);
  volute->throat_area = throat_area(volute);
  return volute->throat_area - volute->input.throat_area;
}

static double throat_area_excess(double end, const void *context) {
  CwVolute trial = *((const Context *)context)->volute;
  return close_spiral(&trial, end);
}

static CwStatus check_input(const CwVoluteInput *in) {
  CwStatus status = CW_OK;
  const int velocity = in->area_law == CW_AREA_LAW_VELOCITY, rectangle = in->section == CW_SECTION_RECTANGLE;
  const struct {
    const char *name;
    double value, least, largest, unit;
    const char *unit_name;
    int optional;
  } ranges[] = {
      {"flow rate", in->flow_rate, 1e-6, 100, 1, "m3/s", 0},
      {"angular momentum c_u2 r2", in->angular_momentum, 1e-4, 1e3, 1, "m2/s", velocity},
      {"speed in the sections (K3 sqrt(2 g H))", in->section_speed, 0.1, 200, 1, "m/s", !velocity},
      {"base_diameter (D3)", in->base_diameter, 0.02, 5, 1e3, "mm", 0},
      {"interface radius", in->interface_radius, 0.0095, 2.5, 1e3, "mm", 0},
      {"outlet width of the impeller (b2)", in->neck_width, 1e-3, 1, 1e3, "mm", 0},
      {"inlet_width (b3)", in->inlet_width, 1e-3, 1, 1e3, "mm", 0},
      {"side_wall_angle", in->side_wall_angle, rectangle ? 0 : PI / 36, PI / 5, 180 / PI, "deg", 0},
      {"corner_radius", in->corner_radius, 0.5e-3, 0.5 * in->inlet_width, 1e3, "mm", !rectangle},
      {"throat_area", in->throat_area, 1e-6, 10, 1e6, "mm2", 1},
      {"tongue_radius", in->tongue_radius, 0.2e-3, 0.02, 1e3, "mm", 0},
      {"tongue_gap", in->tongue_gap, 0, 1, 1e3, "mm", 1},
      {"tongue_angle", in->tongue_angle, 0, 0.45 * PI, 180 / PI, "deg", 1},
      {"least gap of the tongue", in->least_tongue_gap, 0, 1, 1e3, "mm", 1},
      {"diffuser_length", in->diffuser_length, 5e-3, 10, 1e3, "mm", 1},
      {"diffuser angle", in->diffuser_angle, PI / 180, PI / 6, 180 / PI, "deg", !isnan(in->diffuser_length)},
      {"outlet_diameter", in->outlet_diameter, 5e-3, 5, 1e3, "mm", 1},
      {"diffuser_area_ratio", in->diffuser_area_ratio, 1.05, 4, 1, "", 1},
      {"discharge_pipe_length", in->discharge_pipe_length, 1e-3, 50, 1e3, "mm", 0},
  };
  for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
    if (ranges[i].optional && isnan(ranges[i].value))
      continue;
    CW_REQUIRE(ranges[i].value >= ranges[i].least && ranges[i].value <= ranges[i].largest, CW_ERR_DESIGN,
               "volute: %s is %g %s; allowed: %g to %g %s", ranges[i].name, ranges[i].value * ranges[i].unit,
               ranges[i].unit_name, ranges[i].least * ranges[i].unit, ranges[i].largest * ranges[i].unit,
               ranges[i].unit_name);
  }
  CW_REQUIRE(in->inlet_width >= in->neck_width + 1e-3 - 1e-9, CW_ERR_DESIGN,
             "volute: inlet_width (b3) is %g mm; allowed: at least b2 + 1 mm = %g mm", in->inlet_width * 1e3,
             in->neck_width * 1e3 + 1);
  CW_REQUIRE(0.5 * in->base_diameter >= in->interface_radius + 0.25e-3, CW_ERR_DESIGN,
             "volute: base_diameter (D3) is %g mm; allowed: at least %g mm, so that the neck between the "
             "interface at "
             "r = %g mm and D3/2 has 0.25 mm",
             in->base_diameter * 1e3, 2e3 * in->interface_radius + 0.5, in->interface_radius * 1e3);
  CW_REQUIRE(in->inlet_width <= 0.4 * in->base_diameter, CW_ERR_DESIGN,
             "volute: inlet_width (b3) is %g mm; allowed: at most 0.4 D3 = %g mm", in->inlet_width * 1e3,
             400 * in->base_diameter);
  CW_REQUIRE(in->section != CW_SECTION_CIRCLE || isnan(in->corner_radius), CW_ERR_DESIGN,
             "volute: corner_radius is %g mm, but a circle has no corners; allowed: with section trapezoid or "
             "rectangle",
             in->corner_radius * 1e3);
  CW_REQUIRE(isnan(in->tongue_gap) || isnan(in->tongue_angle), CW_ERR_DESIGN,
             "volute: tongue_gap and tongue_angle both place the tongue; allowed: one of them");
  CW_REQUIRE(isnan(in->outlet_diameter) != isnan(in->diffuser_area_ratio), CW_ERR_DESIGN,
             "volute: outlet_diameter and diffuser_area_ratio both give the outlet; allowed: one of them");
done:
  return status;
}

// Ends the spiral so that the throat has the asked area, or by Q and K.
static CwStatus solve_spiral(CwVolute *volute) {
  CwStatus status = CW_OK;
  const CwVoluteInput *in = &volute->input;
  const int velocity = in->area_law == CW_AREA_LAW_VELOCITY;
  const double scale = velocity ? 1e6 : 1e3, r3 = base_radius(volute);
  double end =
      volute->law_start + in->flow_rate / (velocity ? in->section_speed : in->angular_momentum);
  double largest = law_at(volute, LARGEST_SPIRAL * r3, volute->end_half_angle);
  CW_REQUIRE(end < largest, CW_ERR_DESIGN,
             "volute: %s = %g %s needs an outer wall beyond %g D3/2; allowed: at most %g %s (raise the head or b3, or "
             "lower the flow rate)",
             velocity ? "Q / (K3 sqrt(2 g H))" : "Q / (c_u2 r2)", scale * (end - volute->law_start),
             velocity ? "mm2" : "mm", LARGEST_SPIRAL, scale * (largest - volute->law_start), velocity ? "mm2" : "mm");
  if (!isnan(in->throat_area)) {
    Context context = {.volute = volute};
    // The smallest and the largest spirals may have no room for a tongue at all.
    double share = 0.02, low, least_excess, largest_excess;
    do {
      low = volute->law_start + share * (largest - volute->law_start);
      least_excess = throat_area_excess(low, &context);
    } while (isnan(least_excess) && (share *= 1.5) < 0.7);
    while (isnan(largest_excess = throat_area_excess(largest, &context)) && largest > low)
      largest = volute->law_start + 0.8 * (largest - volute->law_start);
    CW_REQUIRE(!isnan(least_excess) && !isnan(largest_excess), CW_ERR_DESIGN,
               "volute: no spiral with this D3 and b3 has room for its tongue%s; lower inlet_width or %s",
               has_corners(volute) ? " and corners" : "", has_corners(volute) ? "corner_radius" : "tongue_radius");
    end = find_root(throat_area_excess, &context, low, largest);
    CW_REQUIRE(!isnan(end), CW_ERR_DESIGN,
               "volute: throat_area is %g mm2; allowed with this D3, b3 and tongue: %.0f to "
               "%.0f mm2",
               in->throat_area * 1e6, (least_excess + in->throat_area) * 1e6,
               (largest_excess + in->throat_area) * 1e6);
  }
  close_spiral(volute, end);
  volute->law_constant = in->flow_rate / (end - volute->law_start);
done:
  return status;
}

static CwStatus check_tongue(const CwVolute *volute) {
  CwStatus status = CW_OK;
  const CwVoluteInput *in = &volute->input;
  double gap = volute->tip_radius - base_radius(volute);
  double least = tongue_at(LEAST_WEDGE, volute), largest = tongue_at(LARGEST_WEDGE, volute);
  CW_REQUIRE(isnan(in->tongue_gap) || fabs(gap - in->tongue_gap) < 1e-7, CW_ERR_DESIGN,
             "volute: tongue_gap is %g mm; allowed for this spiral: %.2f to %.2f mm (or leave it out)",
             in->tongue_gap * 1e3, 1e3 * least, 1e3 * largest);
  CW_REQUIRE(isnan(in->tongue_angle) || fabs(volute->tip_angle - in->tongue_angle) < 1e-7, CW_ERR_DESIGN,
             "volute: tongue_angle is %g deg; allowed for this spiral: %.2f to %.2f deg (or leave it out)",
             in->tongue_angle * 180 / PI, least * 180 / PI, largest * 180 / PI);
  double corner[3] = {volute->inner_wall_x};
  if (!isnan(volute->throat_width))
    cw_volute_wall_point(volute, cw_volute_throat_angle(volute, volute->arc_half_angle), volute->arc_half_angle,
                         corner, NULL, NULL);
  CW_REQUIRE(volute->end_half_angle == ARC_HALF_ANGLE || isnan(volute->throat_width) ||
                 corner[0] > volute->inner_wall_x + in->tongue_radius,
             CW_ERR_DESIGN,
             "volute: %s no side wall at the throat; lower inlet_width or %s, or take section trapezoid%s",
             has_corners(volute) ? "the corners leave" : "the circle leaves",
             has_corners(volute) ? "corner_radius" : "side_wall_angle",
             has_corners(volute) ? " without corner_radius" : "");
  CW_REQUIRE(!isnan(volute->tip_angle) && !isnan(volute->throat_area) &&
                 volute->throat_width > 4 * in->tongue_radius,
             CW_ERR_DESIGN,
             "volute: no tongue of radius %g mm fits this spiral; lower tongue_radius or raise "
             "throat_area",
             in->tongue_radius * 1e3);
done:
  return status;
}

// Every section must lie outside the base circle, also where the arcs grow round.
static CwStatus check_sections(const CwVolute *volute) {
  CwStatus status = CW_OK;
  const int steps = 72;
  for (int i = 0; i <= steps; i++) {
    double phi = volute->start_angle + 2 * PI * i / steps;
    double gap = cw_volute_section(volute, phi).kink_radius - base_radius(volute);
    CW_REQUIRE(gap > START_MARGIN * base_radius(volute), CW_ERR_DESIGN,
               "volute: the section %.0f deg behind the spiral's start is too small for %s; lower %s or "
               "inlet_width, or take section trapezoid%s",
               phi * 180 / PI, has_corners(volute) ? "its corners" : "a circle",
               has_corners(volute) ? "corner_radius" : "side_wall_angle",
               has_corners(volute) ? " without corner_radius" : "");
  }
done:
  return status;
}

// Where the diffuser ends that leaves the throat's middle (x, y) along its lean and turns by `bend` to the
// right on a circle.
static void end_diffuser(CwVolute *volute, double x, double y, double bend) {
  double chord = volute->diffuser_length * (bend > 0 ? sin(bend / 2) / (bend / 2) : 1);
  volute->discharge_lean = volute->throat_lean - bend;
  volute->outlet_x = x - chord * sin(volute->throat_lean - bend / 2);
  volute->outlet_y = y + chord * cos(volute->throat_lean - bend / 2);
}

// Distance of the discharge's axis from the pump's, to the left of it.
static double bend_excess(double bend, const void *context) {
  CwVolute trial = *((const Context *)context)->volute;
  end_diffuser(&trial, trial.outlet_x, trial.outlet_y, bend);
  return trial.outlet_x * cos(trial.discharge_lean) + trial.outlet_y * sin(trial.discharge_lean);
}

// Length or angle of the diffuser, whichever is left open, and the outlet's place.
static CwStatus solve_diffuser(CwVolute *volute) {
  CwStatus status = CW_OK;
  const CwVoluteInput *in = &volute->input;
  if (isnan(in->outlet_diameter))
    volute->input.outlet_diameter = sqrt(in->diffuser_area_ratio * volute->throat_area * 4 / PI);
  double x[3], x_phi[3], radius = 0.5 * in->outlet_diameter, throat_radius = sqrt(volute->throat_area / PI);
  CW_REQUIRE(radius > throat_radius, CW_ERR_DESIGN,
             "volute: outlet_diameter is %g mm, less than the throat's equal-area diameter %.2f mm; raise "
             "it, or lower "
             "throat_area (%.0f mm2)",
             2e3 * radius, 2e3 * throat_radius, volute->throat_area * 1e6);
  volute->diffuser_length = in->diffuser_length;
  if (isnan(in->diffuser_length))
    volute->diffuser_length = fmax((radius - throat_radius) / tan(0.5 * in->diffuser_angle),
                                   in->discharge == CW_DISCHARGE_RADIAL ? 4 * radius : 0.5 * radius);
  volute->diffuser_angle = 2 * atan((radius - throat_radius) / volute->diffuser_length);
  CW_REQUIRE(volute->diffuser_angle < PI / 6, CW_ERR_DESIGN,
             "volute: diffuser_length %g mm opens the diffuser by %.1f deg; allowed: at most 30 deg (at "
             "least %.1f mm)",
             volute->diffuser_length * 1e3, volute->diffuser_angle * 180 / PI,
             1e3 * (radius - throat_radius) / tan(PI / 12));
  // Midway between the walls at the throat, along the mean of their directions there.
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, 0), 0, x, x_phi, NULL);
  volute->throat_lean = 0.5 * atan2(-x_phi[0], x_phi[1]);
  const double middle = 0.5 * (volute->inner_wall_x + x[0]);
  double bend = 0;
  if (in->discharge == CW_DISCHARGE_RADIAL) {
    volute->outlet_x = middle;
    volute->outlet_y = volute->throat_y;
    Context context = {.volute = volute};
    bend = find_root(bend_excess, &context, 1e-3, 0.6 * PI);
    CW_REQUIRE(volute->diffuser_length >= 1.5 * radius * bend, CW_ERR_DESIGN,
               "volute: diffuser_length %g mm is too short for a radial discharge, which bends it by %.0f deg; "
               "allowed: at least %.1f mm",
               volute->diffuser_length * 1e3, bend * 180 / PI, 1.5e3 * radius * bend);
  }
  end_diffuser(volute, middle, volute->throat_y, bend);
  volute->diffuser_area_ratio = radius * radius / (throat_radius * throat_radius);
done:
  return status;
}

CwStatus cw_volute_design(const CwVoluteInput *input, CwVolute *volute) {
  CwStatus status = CW_OK;
  memset(volute, 0, sizeof *volute);
  volute->input = *input;
  if (input->section == CW_SECTION_RECTANGLE)
    volute->input.side_wall_angle = 0;
  CW_TRY(check_input(&volute->input));
  volute->arc_half_angle = volute->end_half_angle = ARC_HALF_ANGLE;
  if (input->section == CW_SECTION_CIRCLE || has_corners(volute))
    volute->end_half_angle = 0.5 * PI + volute->input.side_wall_angle;
  volute->law_start = law_at(volute, base_radius(volute) * (1 + START_MARGIN), ARC_HALF_ANGLE);
  CW_TRY(solve_spiral(volute));

  double k = volute->arc_half_angle, x[3], centre[2], normal[2];
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, 0), 0, x, NULL, NULL);
  volute->throat_width = x[0] - volute->inner_wall_x;
  CW_TRY(check_sections(volute));
  CW_TRY(check_tongue(volute));
  volute->side_level = cw_volute_section(volute, volute->start_angle).kink_height;
  cw_volute_contact_circle(volute, volute->start_angle, k, centre, normal);
  volute->side_centre_y = centre[1];
  // One-sided, of second order: above this level there is no wall.
  double step = 1e-4 * volute->side_level;
  double near = cw_volute_nose_y(volute, volute->side_level - step);
  double far = cw_volute_nose_y(volute, volute->side_level - 2 * step);
  volute->side_centre_slope = (3 * centre[1] - 4 * near + far) / (2 * step);
  CW_TRY(solve_diffuser(volute));
done:
  return status;
}
