// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/volute_design.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

// The spiral begins this share of D3/2 outside it: a section that begins at nothing has no outer wall.
static const double START_MARGIN = 0.003;
// Half angle of the outer arc. A larger one sweeps the nose back more: with 60 degrees it leans so far that
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

// The section whose kink lies at r_k; without its slope.
static CwVoluteSection section_at(const CwVolute *volute, double r_k) {
  double r3 = base_radius(volute), k = volute->arc_half_angle;
  CwVoluteSection s = {.kink_radius = r_k, .kink_height = cw_volute_half_width(volute, r_k)};
  s.arc_radius = s.kink_height / sin(k);
  s.arc_centre = r_k - s.arc_radius * cos(k);
  s.outer_radius = s.arc_centre + s.arc_radius;
  double c = s.arc_centre, rho = s.arc_radius;
  s.area = (0.5 * volute->input.inlet_width + s.kink_height) * (r_k - r3) + rho * rho * (k - sin(k) * cos(k));
  // Integral of rho^2 sin^2 psi / (c + rho cos psi) over 0..k, in closed form on either side of c = rho.
  double d = (c - rho) * (c + rho), t = tan(k / 2) * sqrt(fabs((c - rho) / (c + rho)));
  double arc = c * k - rho * sin(k) + 2 * sqrt(fabs(d)) * (d > 0 ? -atan(t) : atanh(t));
  s.integral =
      trapezoid_integral(r3, volute->input.inlet_width, tan(volute->input.side_wall_angle), r_k) + 2 * arc;
  return s;
}

typedef struct {
  const CwVolute *volute;
  double value; // what the function is to reach
  double psi, level, beta;
} Context;

static double integral_excess(double r_k, const void *context) {
  const Context *c = context;
  return section_at(c->volute, r_k).integral - c->value;
}

CwVoluteSection cw_volute_section(const CwVolute *volute, double phi) {
  double growth = (volute->integral_end - volute->integral_start) / (2 * PI), r3 = base_radius(volute);
  Context context = {.volute = volute, .value = volute->integral_start + growth * phi};
  double r_k = find_root(integral_excess, &context, r3, 3 * r3);
  CwVoluteSection s = section_at(volute, r_k);
  double step = 1e-4 * r3;
  double slope =
      (section_at(volute, r_k + step).integral - section_at(volute, r_k - step).integral) / (2 * step);
  s.kink_slope = growth / slope;
  return s;
}

void cw_volute_wall_point(const CwVolute *volute, double phi, double psi, double x[3], double x_phi[3],
                          double x_psi[3]) {
  CwVoluteSection s = cw_volute_section(volute, phi);
  double k = volute->arc_half_angle;
  double rho_phi = s.kink_slope * tan(volute->input.side_wall_angle) / sin(k);
  double centre_phi = s.kink_slope - rho_phi * cos(k);
  double r = s.arc_centre + s.arc_radius * cos(psi), r_phi = centre_phi + rho_phi * cos(psi);
  double r_psi = -s.arc_radius * sin(psi);
  x[0] = r * cos(phi);
  x[1] = r * sin(phi);
  x[2] = s.arc_radius * sin(psi);
  if (x_phi) {
    x_phi[0] = r_phi * cos(phi) - r * sin(phi);
    x_phi[1] = r_phi * sin(phi) + r * cos(phi);
    x_phi[2] = rho_phi * sin(psi);
  }
  if (x_psi) {
    x_psi[0] = r_psi * cos(phi);
    x_psi[1] = r_psi * sin(phi);
    x_psi[2] = s.arc_radius * cos(psi);
  }
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
  double sine = c.level / cw_volute_section(c.volute, phi).arc_radius;
  c.psi = asin(fmin(sine, 1));
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
  double psi = asin(fmin(w / cw_volute_section(volute, phi).arc_radius, 1)), centre[2], normal[2];
  cw_volute_contact_circle(volute, phi, psi, centre, normal);
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
  step = k / COUNT;
  for (int i = 0; i <= COUNT; i++) {
    double weight = i == 0 || i == COUNT ? 1 : i % 2 ? 4 : 2;
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
  volute->start_angle = find_root(wedge_excess, &context, 0, 0.45 * PI);
  cw_volute_contact_circle(volute, volute->start_angle, volute->arc_half_angle, centre, normal);
  volute->inner_wall_x = centre[0] + volute->input.tongue_radius;
  volute->tip_angle = cw_volute_contact_angle(volute, 0);
  cw_volute_contact_circle(volute, volute->tip_angle, 0, centre, normal);
  volute->tip_radius = hypot(centre[0], centre[1]) - volute->input.tongue_radius;
  volute->throat_y = centre[1] + THROAT_SETBACK * volute->input.tongue_radius;
}

static double gap_at(double wedge, const CwVolute *volute) {
  CwVolute trial = *volute;
  place_tongue(&trial, wedge);
  return trial.tip_radius - base_radius(&trial);
}

static double gap_excess(double wedge, const void *context) {
  const Context *c = context;
  return gap_at(wedge, c->volute) - c->value;
}

// Throat area of a spiral that ends with the integral `end`, less the asked one.
static double close_spiral(CwVolute *volute, double end) {
  volute->integral_end = end;
  Context context = {.volute = volute, .value = volute->input.tongue_gap};
  double wedge = DEFAULT_WEDGE;
  if (isnan(context.value) && gap_at(wedge, volute) < volute->input.least_tongue_gap)
    context.value = volute->input.least_tongue_gap;
  if (!isnan(context.value)) {
    wedge = find_root(gap_excess, &context, LEAST_WEDGE, LARGEST_WEDGE);
    if (isnan(wedge)) // the nearest tongue; where the gap is given, check_tongue() then says what is allowed
      wedge = gap_excess(LEAST_WEDGE, &context) > 0 ? LEAST_WEDGE : LARGEST_WEDGE;
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
  const struct {
    const char *name;
    double value, least, largest, unit;
    const char *unit_name;
    int optional;
  } ranges[] = {
      {"flow rate", in->flow_rate, 1e-6, 100, 1, "m3/s", 0},
      {"angular momentum c_u2 r2", in->angular_momentum, 1e-4, 1e3, 1, "m2/s", 0},
      {"base_diameter (D3)", in->base_diameter, 0.02, 5, 1e3, "mm", 0},
      {"interface radius", in->interface_radius, 0.0095, 2.5, 1e3, "mm", 0},
      {"outlet width of the impeller (b2)", in->neck_width, 1e-3, 1, 1e3, "mm", 0},
      {"inlet_width (b3)", in->inlet_width, 1e-3, 1, 1e3, "mm", 0},
      {"side_wall_angle", in->side_wall_angle, PI / 36, PI / 5, 180 / PI, "deg", 0},
      {"throat_area", in->throat_area, 1e-6, 10, 1e6, "mm2", 1},
      {"tongue_radius", in->tongue_radius, 0.2e-3, 0.02, 1e3, "mm", 0},
      {"tongue_gap", in->tongue_gap, 0, 1, 1e3, "mm", 1},
      {"least gap of the tongue", in->least_tongue_gap, 0, 1, 1e3, "mm", 1},
      {"diffuser_length", in->diffuser_length, 5e-3, 10, 1e3, "mm", 1},
      {"diffuser angle", in->diffuser_angle, PI / 180, PI / 6, 180 / PI, "deg", !isnan(in->diffuser_length)},
      {"outlet_diameter", in->outlet_diameter, 5e-3, 5, 1e3, "mm", 0},
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
done:
  return status;
}

// Ends the spiral so that the throat has the asked area, or by Q and K.
static CwStatus solve_spiral(CwVolute *volute) {
  CwStatus status = CW_OK;
  const CwVoluteInput *in = &volute->input;
  double end = volute->integral_start + in->flow_rate / in->angular_momentum, r3 = base_radius(volute);
  double largest = section_at(volute, 1.9 * r3).integral;
  CW_REQUIRE(end < largest, CW_ERR_DESIGN,
             "volute: Q / (c_u2 r2) = %g mm needs an outer wall beyond 1.9 D3/2; allowed: at most %g mm "
             "(raise the head "
             "or b3, or lower the flow rate)",
             1e3 * in->flow_rate / in->angular_momentum, 1e3 * (largest - volute->integral_start));
  if (!isnan(in->throat_area)) {
    Context context = {.volute = volute};
    double low = volute->integral_start + 0.02 * (largest - volute->integral_start);
    double least_excess = throat_area_excess(low, &context),
           largest_excess = throat_area_excess(largest, &context);
    end = find_root(throat_area_excess, &context, low, largest);
    CW_REQUIRE(!isnan(end), CW_ERR_DESIGN,
               "volute: throat_area is %g mm2; allowed with this D3, b3 and tongue: %.0f to "
               "%.0f mm2",
               in->throat_area * 1e6, (least_excess + in->throat_area) * 1e6,
               (largest_excess + in->throat_area) * 1e6);
  }
  close_spiral(volute, end);
  volute->design_momentum = in->flow_rate / (end - volute->integral_start);
done:
  return status;
}

static CwStatus check_tongue(const CwVolute *volute) {
  CwStatus status = CW_OK;
  const CwVoluteInput *in = &volute->input;
  double gap = volute->tip_radius - base_radius(volute);
  double least = gap_at(LEAST_WEDGE, volute), largest = gap_at(LARGEST_WEDGE, volute);
  CW_REQUIRE(isnan(in->tongue_gap) || fabs(gap - in->tongue_gap) < 1e-7, CW_ERR_DESIGN,
             "volute: tongue_gap is %g mm; allowed for this spiral: %.2f to %.2f mm (or leave it out)",
             in->tongue_gap * 1e3, 1e3 * least, 1e3 * largest);
  CW_REQUIRE(!isnan(volute->tip_angle) && !isnan(volute->throat_area) &&
                 volute->throat_width > 4 * in->tongue_radius,
             CW_ERR_DESIGN,
             "volute: no tongue of radius %g mm fits this spiral; lower tongue_radius or raise "
             "throat_area",
             in->tongue_radius * 1e3);
done:
  return status;
}

// Length or angle of the diffuser, whichever is left open, and the outlet's place.
static CwStatus solve_diffuser(CwVolute *volute) {
  CwStatus status = CW_OK;
  const CwVoluteInput *in = &volute->input;
  double x[3], x_phi[3], radius = 0.5 * in->outlet_diameter, throat_radius = sqrt(volute->throat_area / PI);
  CW_REQUIRE(radius > throat_radius, CW_ERR_DESIGN,
             "volute: outlet_diameter is %g mm, less than the throat's equal-area diameter %.2f mm; raise "
             "it, or lower "
             "throat_area (%.0f mm2)",
             2e3 * radius, 2e3 * throat_radius, volute->throat_area * 1e6);
  volute->diffuser_length = in->diffuser_length;
  if (isnan(in->diffuser_length))
    volute->diffuser_length = fmax((radius - throat_radius) / tan(0.5 * in->diffuser_angle), 0.5 * radius);
  volute->diffuser_angle = 2 * atan((radius - throat_radius) / volute->diffuser_length);
  CW_REQUIRE(volute->diffuser_angle < PI / 6, CW_ERR_DESIGN,
             "volute: diffuser_length %g mm opens the diffuser by %.1f deg; allowed: at most 30 deg (at "
             "least %.1f mm)",
             volute->diffuser_length * 1e3, volute->diffuser_angle * 180 / PI,
             1e3 * (radius - throat_radius) / tan(PI / 12));
  // Midway between the walls at the throat, along the mean of their directions there.
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, 0), 0, x, x_phi, NULL);
  volute->discharge_lean = 0.5 * atan2(-x_phi[0], x_phi[1]);
  volute->outlet_x =
      0.5 * (volute->inner_wall_x + x[0]) - volute->diffuser_length * sin(volute->discharge_lean);
  volute->outlet_y = volute->throat_y + volute->diffuser_length * cos(volute->discharge_lean);
done:
  return status;
}

CwStatus cw_volute_design(const CwVoluteInput *input, CwVolute *volute) {
  CwStatus status = CW_OK;
  memset(volute, 0, sizeof *volute);
  volute->input = *input;
  CW_TRY(check_input(input));
  volute->arc_half_angle = ARC_HALF_ANGLE;
  volute->integral_start = section_at(volute, base_radius(volute) * (1 + START_MARGIN)).integral;
  CW_TRY(solve_spiral(volute));

  double k = volute->arc_half_angle, x[3], centre[2], normal[2];
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, 0), 0, x, NULL, NULL);
  volute->throat_width = x[0] - volute->inner_wall_x;
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
