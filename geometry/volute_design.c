// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/volute_design.h"

#include <math.h>
#include <string.h>

#include "geometry/root.h"
#include "geometry/volute_diffuser.h"
#include "geometry/volute_section.h"
#include "geometry/volute_tongue.h"

// The spiral begins this share of D3/2 outside it: a section that begins at nothing has no outer wall.
static const double START_MARGIN = 0.003;
// The kink at the end of the spiral lies within so many D3/2: enough for nq 60 or so.
static const double LARGEST_SPIRAL = 2.5;
// Least length of the neck before the step from b2 to b3, in D3.
static const double LEAST_NECK = 1.25e-3;
static const double SLACK = 1e-9; // of values that went through other units
// Half angle of the outer arc at the tongue. A larger one sweeps the nose back more: with 60 degrees it leans
// so far that its edge to the flank has a radius of 0.05 mm (0.4 mm with 35); a smaller one sharpens the kink
// between outer and side walls (105 degrees with 35 and side walls at 20).
static const double ARC_HALF_ANGLE = 35 * M_PI / 180;
// A flatter arc brings the tongue's tip nearer to the base circle. Where the tongue is given and the tip else lies too
// far out, the arc is flattened in steps, while kink and side wall keep a corner of at least LEAST_CORNER.
static const double ARC_STEP = 5 * M_PI / 180, LEAST_ARC = 5 * M_PI / 180, LEAST_CORNER = 75 * M_PI / 180;
// Angle of the kink line to the tongue's flank where the nose begins, by default and at its limits. The
// smaller it is, the further the nose lies along the side walls, and the sharper are the corners of the faces
// there.
static const double DEFAULT_WEDGE = 26 * M_PI / 180, LEAST_WEDGE = 15 * M_PI / 180, LARGEST_WEDGE = 42 * M_PI / 180;
// The spiral's kink at the tongue lies within these, in D3/2: nearer, the tongue's sides would touch the base circle.
static const double LEAST_START = 1.02, LARGEST_START = 1.35;
// Least share of Q that the throat passes by the law: one-dimensional theory is no better than that.
static const double THROAT_SHARE = 0.98;
static const double LARGEST_GROWTH = 3; // of the spiral for it, over that of the law
// Least share of the side walls in the throat's width where arcs touch them: beside a narrower one the
// diffuser's outer wall, which overhangs there, folds over.
static const double LEAST_SIDE = 0.25;
static const double LEAST_THROAT = 4; // width, in nose radii
// The throat lies this many nose radii behind the centre of the nose, so that the flank is no needle.
static const double THROAT_SETBACK = 2.0;

typedef struct {
  const CwVolute *volute;
  double value; // what the function is to reach
} Context;

// Speed through the cut at y = y_t over the constant of the law: the tongue turns the flow square to the cut.
static double strip_weight(CwAreaLaw law, double x, double y) {
  return law == CW_AREA_LAW_VELOCITY ? 1 : 1 / hypot(x, y);
}

// Flow through the cut at y = y_t over the constant of the law: the area, or the integral of b dx / r. 2 z dx along the
// side wall, then along the arc (Simpson's rule).
static double throat_sum(const CwVolute *volute, CwAreaLaw law) {
  enum { COUNT = 64 };
  double k = volute->arc_half_angle, y = volute->throat_y, sum = 0, corner[3];
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, k), k, corner, NULL, NULL);
  double step = (corner[0] - volute->inner_wall_x) / COUNT;
  for (int i = 0; i <= COUNT; i++) {
    double weight = i == 0 || i == COUNT ? 1 : i % 2 ? 4 : 2, at = volute->inner_wall_x + i * step;
    sum += weight * 2 * step / 3 * cw_volute_half_width(volute, hypot(at, y)) * strip_weight(law, at, y);
  }
  const int count = cw_volute_has_corners(volute) ? 8 * COUNT : COUNT; // the contour's curvature jumps at its corners
  step = k / count;
  for (int i = 0; i <= count; i++) {
    double weight = i == 0 || i == count ? 1 : i % 2 ? 4 : 2;
    double psi = k - i * step, phi = cw_volute_throat_angle(volute, psi), x[3], x_phi[3], x_psi[3];
    cw_volute_wall_point(volute, phi, psi, x, x_phi, x_psi);
    double x_along = x_psi[0] - x_phi[0] * x_psi[1] / x_phi[1]; // dx/dpsi at constant y
    sum -= weight * 2 * step / 3 * x[2] * x_along * strip_weight(law, x[0], y);
  }
  return sum;
}

static double wedge_excess(double phi, const void *context) {
  const Context *c = context;
  CwVoluteSection s = cw_volute_section(c->volute, phi);
  return phi - atan(s.kink_slope / s.kink_radius) - c->value;
}

// Places the tongue where the kink line begins at `start_angle`: x_i, tip and throat.
static void place_tongue(CwVolute *volute, double start_angle) {
  double centre[2], normal[2];
  volute->start_angle = start_angle;
  cw_volute_contact_circle(volute, volute->start_angle, volute->arc_half_angle, centre, normal);
  volute->inner_wall_x = centre[0] + volute->input.tongue_radius;
  volute->tip_angle = cw_volute_contact_angle(volute, 0);
  cw_volute_contact_circle(volute, volute->tip_angle, 0, centre, normal);
  volute->tip_radius = hypot(centre[0], centre[1]) - volute->input.tongue_radius;
  volute->throat_y = centre[1] + THROAT_SETBACK * volute->input.tongue_radius;
}

// The same where the kink line begins at the angle `wedge` to the flank.
static void place_tongue_by_wedge(CwVolute *volute, double wedge) {
  const Context context = {.volute = volute, .value = wedge};
  volute->start_angle = 2 * M_PI; // so that the arcs keep their angle at the tongue while it is looked for
  place_tongue(volute, cw_root_find(wedge_excess, &context, 0, 0.45 * M_PI));
}

static double gap_of(const CwVolute *volute) {
  return volute->tip_radius - cw_volute_base_radius(volute);
}

// Places the tongue at the default wedge where the spiral's kink lies at `kink_radius`, by moving the law's start.
static void place_tongue_at(CwVolute *volute, double kink_radius) {
  const double growth = volute->law_end - volute->law_start, step = 1e-4 * cw_volute_base_radius(volute);
  const double arc = volute->arc_half_angle;
  const double slope =
      (cw_volute_law(volute, kink_radius + step, arc) - cw_volute_law(volute, kink_radius - step, arc)) / (2 * step);
  const double angle = DEFAULT_WEDGE + atan(growth / (2 * M_PI) / slope / kink_radius);
  volute->law_start = cw_volute_law(volute, kink_radius, arc) - growth / (2 * M_PI) * angle;
  volute->law_end = volute->law_start + growth;
  place_tongue(volute, angle);
}

static double gap_excess(double kink_radius, const void *context) {
  const Context *c = context;
  CwVolute trial = *c->volute;
  place_tongue_at(&trial, kink_radius);
  return gap_of(&trial) - c->value;
}

static double angle_excess(double wedge, const void *context) {
  const Context *c = context;
  CwVolute trial = *c->volute;
  place_tongue_by_wedge(&trial, wedge);
  return trial.tip_angle - c->value;
}

// The root of a function in a range; where it has none there, the end that is nearest to it.
static double nearest_root(CwRootFunction excess, const Context *context, double low, double high) {
  const double root = cw_root_find(excess, context, low, high);
  if (!isnan(root)) return root;
  return !(fabs(excess(low, context)) > fabs(excess(high, context))) ? low : high;
}

// The tongue that the input asks for, or the nearest.
static void choose_tongue(CwVolute *volute) {
  const CwVoluteInput *in = &volute->input;
  const double least = LEAST_START * cw_volute_base_radius(volute),
               largest = LARGEST_START * cw_volute_base_radius(volute);
  if (!isnan(in->tongue_angle)) {
    const Context context = {.volute = volute, .value = in->tongue_angle};
    place_tongue_by_wedge(volute, nearest_root(angle_excess, &context, LEAST_WEDGE, LARGEST_WEDGE));
    return;
  }
  place_tongue_by_wedge(volute, DEFAULT_WEDGE);
  if (!(cw_volute_section(volute, volute->start_angle).kink_radius >= least)) place_tongue_at(volute, least);
  double wanted = gap_of(volute);
  if (!isnan(in->tongue_gap))
    wanted = in->tongue_gap;
  else if (wanted < in->tongue_gap_range[0])
    wanted = in->tongue_gap_range[0];
  else if (wanted > in->tongue_gap_range[1])
    wanted = in->tongue_gap_range[1];
  if (wanted == gap_of(volute)) return;
  const Context context = {.volute = volute, .value = wanted};
  place_tongue_at(volute, nearest_root(gap_excess, &context, least, largest));
}

// Makes the spiral of a law that grows by `growth` in one turn, with its tongue and throat.
static void close_spiral(CwVolute *volute, double growth) {
  volute->law_start = cw_volute_law(volute, cw_volute_base_radius(volute) * (1 + START_MARGIN), volute->arc_half_angle);
  volute->law_end = volute->law_start + growth;
  choose_tongue(volute);
  volute->throat_area = throat_sum(volute, CW_AREA_LAW_VELOCITY);
}

static double throat_area_excess(double growth, const void *context) {
  CwVolute trial = *((const Context *)context)->volute;
  close_spiral(&trial, growth);
  return trial.throat_area - trial.input.throat_area;
}

// What the throat passes by the law, less what it has to.
static double throat_flow_excess(double growth, const void *context) {
  const Context *c = context;
  CwVolute trial = *c->volute;
  close_spiral(&trial, growth);
  return throat_sum(&trial, trial.input.area_law) - c->value;
}

static CwStatus check_input(const CwVoluteInput *in) {
  CwStatus status = CW_OK;
  const int velocity = in->area_law == CW_AREA_LAW_VELOCITY, rectangle = in->section == CW_SECTION_RECTANGLE;
  const double d3 = in->base_diameter, area = d3 * d3;
  const struct {
    const char *name;
    double value, least, largest, unit;
    const char *unit_name;
    int optional;
  } ranges[] = {
      {"flow rate", in->flow_rate, 1e-12, 1e6, 1, "m3/s", 0},
      {"flow rate in the discharge", in->pipe_flow_rate, 1e-12, 1e6, 1, "m3/s", 0},
      {"angular momentum c_u2 r2", in->angular_momentum, 1e-12, 1e6, 1, "m2/s", velocity},
      {"speed in the sections (K3 sqrt(2 g H))", in->section_speed, 1e-6, 1e6, 1, "m/s", !velocity},
      {"base_diameter_mm (D3)", d3, 1e-6, 1e3, 1e3, "mm", 0},
      {"interface radius", in->interface_radius, 0.05 * d3, 0.5 * d3, 1e3, "mm", 0},
      {"outlet_width_mm (b2)", in->neck_width, 1e-3 * d3, 0.39 * d3, 1e3, "mm", 0},
      {"inlet_width_mm (b3)", in->inlet_width, in->neck_width + CW_VOLUTE_LEAST_STEP * d3, 0.4 * d3, 1e3, "mm", 0},
      {"side_wall_angle_deg", in->side_wall_angle, rectangle ? 0 : CW_VOLUTE_LEAST_SIDE_WALL, M_PI / 5, 180 / M_PI,
       "deg", 0},
      {"corner_radius_mm", in->corner_radius, 2.5e-3 * d3, 0.5 * in->inlet_width, 1e3, "mm", !rectangle},
      {"throat_area_mm2", in->throat_area, 1e-6 * area, 10 * area, 1e6, "mm2", 1},
      {"tongue_radius_mm", in->tongue_radius, 1e-3 * d3, 0.1 * d3, 1e3, "mm", 0},
      {"tongue_gap_mm", in->tongue_gap, 0, d3, 1e3, "mm", 1},
      {"tongue_angle_deg", in->tongue_angle, 0, 0.45 * M_PI, 180 / M_PI, "deg", 1},
      {"diffuser_length_mm", in->diffuser_length, 0.02 * d3, 50 * d3, 1e3, "mm", 1},
      {"diffuser_angle_deg", in->diffuser_angle, M_PI / 180, M_PI / 6, 180 / M_PI, "deg", !isnan(in->diffuser_length)},
      {"outlet_diameter_mm", in->outlet_diameter, 0.01 * d3, 5 * d3, 1e3, "mm", 1},
      {"diffuser_area_ratio", in->diffuser_area_ratio, 1.05, 4, 1, "", 1},
      {"discharge_pipe_length_mm", in->discharge_pipe_length, 5e-3 * d3, 1e3 * d3, 1e3, "mm", 1},
  };
  for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
    if (ranges[i].optional && isnan(ranges[i].value)) continue;
    CW_REQUIRE(ranges[i].value >= (1 - SLACK) * ranges[i].least && ranges[i].value <= (1 + SLACK) * ranges[i].largest,
               CW_ERR_DESIGN, "volute: %s is %g %s; allowed with this D3 and b2: %.6g to %.6g %s", ranges[i].name,
               ranges[i].value * ranges[i].unit, ranges[i].unit_name, ranges[i].least * ranges[i].unit,
               ranges[i].largest * ranges[i].unit, ranges[i].unit_name);
  }
  // The interface lies half-way between the wheel and D3/2, and moves out with a greater D3.
  const double wheel = 2 * in->interface_radius - 0.5 * d3, least_d3 = 2 * wheel / (1 - 4 * LEAST_NECK);
  CW_REQUIRE(0.5 * d3 >= in->interface_radius + LEAST_NECK * d3 * (1 - SLACK), CW_ERR_DESIGN,
             "volute: base_diameter_mm (D3) is %g mm; allowed: at least %.2f mm, so that the neck from the interface, "
             "now at r = %g mm, to D3/2 has %.2g D3",
             d3 * 1e3, ceil(1e5 * (1 - SLACK) * least_d3) / 100, in->interface_radius * 1e3, LEAST_NECK);
  CW_REQUIRE(in->section != CW_SECTION_CIRCLE || isnan(in->corner_radius), CW_ERR_DESIGN,
             "volute: corner_radius_mm is %g mm, but a circle has no corners; allowed: with section trapezoid or "
             "rectangle",
             in->corner_radius * 1e3);
  CW_REQUIRE(isnan(in->tongue_gap) || isnan(in->tongue_angle), CW_ERR_DESIGN,
             "volute: tongue_gap_mm and tongue_angle_deg both place the tongue; allowed: one of them");
  CW_REQUIRE(isnan(in->outlet_diameter) || isnan(in->diffuser_area_ratio), CW_ERR_DESIGN,
             "volute: outlet_diameter_mm and diffuser_area_ratio both give the outlet; allowed: one of them");
done:
  return status;
}

static void could_help(CwVolute *volute, CwVoluteHelp help) {
  if (help > volute->help) volute->help = help;
}

// The growth of the law with which the throat has the asked area.
static CwStatus growth_for_area(CwVolute *volute, double largest, double *growth) {
  CwStatus status = CW_OK;
  Context context = {.volute = volute};
  // The smallest and the largest spirals may have no room for a tongue at all.
  double share = 0.02, low, least_excess, largest_excess;
  do {
    low = share * largest;
    least_excess = throat_area_excess(low, &context);
  } while (isnan(least_excess) && (share *= 1.5) < 0.7);
  while (isnan(largest_excess = throat_area_excess(largest, &context)) && largest > low) largest *= 0.8;
  if (!(least_excess <= 0 && largest_excess >= 0))
    could_help(volute, largest_excess < 0 ? CW_VOLUTE_WIDER_SPIRAL : CW_VOLUTE_THINNER_TONGUE);
  CW_REQUIRE(!isnan(least_excess) && !isnan(largest_excess), CW_ERR_DESIGN,
             "volute: no spiral with D3 = %g and b3 = %g mm has room for its tongue of radius %g mm%s; lower "
             "inlet_width_mm or %s",
             volute->input.base_diameter * 1e3, volute->input.inlet_width * 1e3, volute->input.tongue_radius * 1e3,
             cw_volute_has_corners(volute) ? " and its corners" : "",
             cw_volute_has_corners(volute) ? "corner_radius_mm" : "tongue_radius_mm");
  *growth = cw_root_find(throat_area_excess, &context, low, largest);
  CW_REQUIRE(!isnan(*growth), CW_ERR_DESIGN,
             "volute: throat_area_mm2 is %g mm2; allowed with this D3, b3 and tongue: %.6g to %.6g mm2",
             volute->input.throat_area * 1e6, (least_excess + volute->input.throat_area) * 1e6,
             (largest_excess + volute->input.throat_area) * 1e6);
done:
  return status;
}

// The growth of the law with which the throat passes its least share of Q: `asked`, or more. The largest spirals may
// have no room for a tongue at all.
static CwStatus growth_for_flow(CwVolute *volute, double asked, double largest, double *growth) {
  CwStatus status = CW_OK;
  const Context context = {.volute = volute, .value = THROAT_SHARE * asked};
  *growth = asked;
  if (!(throat_flow_excess(asked, &context) < 0)) goto done;
  *growth = NAN;
  for (double most = fmin(largest, LARGEST_GROWTH * asked); isnan(*growth) && most > asked; most *= 0.8)
    *growth = cw_root_find(throat_flow_excess, &context, asked, most);
  if (isnan(*growth)) could_help(volute, CW_VOLUTE_THINNER_TONGUE);
  CW_REQUIRE(!isnan(*growth), CW_ERR_DESIGN,
             "volute: beside its tongue of radius %g mm the throat passes less than %g Q by the law, also of a spiral "
             "for %g Q; lower inlet_width_mm or tongue_radius_mm, or give throat_area_mm2",
             volute->input.tongue_radius * 1e3, THROAT_SHARE, LARGEST_GROWTH);
done:
  return status;
}

// Ends the spiral so that the throat has the asked area, or by the law. The tongue's thickness is taken away from the
// last section; where the throat would then pass less than Q by the law, the spiral grows by more.
static CwStatus solve_spiral(CwVolute *volute) {
  CwStatus status = CW_OK;
  const CwVoluteInput *in = &volute->input;
  const int velocity = in->area_law == CW_AREA_LAW_VELOCITY;
  const double scale = velocity ? 1e6 : 1e3, r3 = cw_volute_base_radius(volute);
  const double asked = in->flow_rate / (velocity ? in->section_speed : in->angular_momentum);
  const double largest = cw_volute_law(volute, LARGEST_SPIRAL * r3, volute->end_half_angle) - volute->law_start;
  double growth = asked;
  if (asked >= largest) could_help(volute, CW_VOLUTE_WIDER_SPIRAL);
  CW_REQUIRE(asked < largest, CW_ERR_DESIGN,
             "volute: %s = %g %s needs an outer wall beyond %g D3/2; allowed: at most %g %s: raise inlet_width_mm, "
             "side_wall_angle_deg or outlet_diameter_mm",
             velocity ? "Q / (K3 sqrt(2 g H))" : "Q / (c_u2 r2)", scale * asked, velocity ? "mm2" : "mm",
             LARGEST_SPIRAL, scale * largest, velocity ? "mm2" : "mm");
  if (!isnan(in->throat_area)) {
    CW_TRY(growth_for_area(volute, largest, &growth));
  } else {
    CW_TRY(growth_for_flow(volute, asked, largest, &growth));
  }
  close_spiral(volute, growth);
  volute->law_constant = in->flow_rate / growth;
done:
  return status;
}

// What makes room for corners, or for a circle.
static const char *room_by(const CwVolute *volute) {
  return cw_volute_has_corners(volute)
             ? "lower corner_radius_mm or inlet_width_mm, or take section trapezoid without corner_radius_mm"
             : "lower side_wall_angle_deg or inlet_width_mm, or take section trapezoid";
}

static CwStatus check_tongue(const CwVolute *volute) {
  CwStatus status = CW_OK;
  const CwVoluteInput *in = &volute->input;
  double corner[3];
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, volute->arc_half_angle), volute->arc_half_angle, corner,
                       NULL, NULL);
  CW_REQUIRE(volute->end_half_angle == volute->arc_half_angle ||
                 corner[0] - volute->inner_wall_x > LEAST_SIDE * volute->throat_width,
             CW_ERR_DESIGN, "volute: %s %.2f of the throat's width to its side walls; allowed: at least %.2f: %s",
             cw_volute_has_corners(volute) ? "the corners leave" : "the circle leaves",
             (corner[0] - volute->inner_wall_x) / volute->throat_width, LEAST_SIDE, room_by(volute));
  CW_REQUIRE(
      volute->throat_width > LEAST_THROAT * in->tongue_radius, CW_ERR_DESIGN,
      "volute: no tongue of radius %g mm fits beside a throat %.4g mm wide; allowed: less than a quarter of that: "
      "lower tongue_radius_mm or raise throat_area_mm2 (%.4g mm2)",
      in->tongue_radius * 1e3, volute->throat_width * 1e3, volute->throat_area * 1e6);
done:
  return status;
}

// Every section must lie outside the base circle, also where the arcs grow round.
static CwStatus check_sections(const CwVolute *volute) {
  CwStatus status = CW_OK;
  const int steps = 72;
  for (int i = 0; i <= steps; i++) {
    double phi = volute->start_angle + 2 * M_PI * i / steps;
    double gap = cw_volute_section(volute, phi).kink_radius - cw_volute_base_radius(volute);
    CW_REQUIRE(
        gap > START_MARGIN * cw_volute_base_radius(volute), CW_ERR_DESIGN,
        "volute: the section %.0f deg behind the spiral's start has side walls of %.3g mm (more than %.3g mm are "
        "allowed) and is too small for %s; %s",
        phi * 180 / M_PI, gap * 1e3, START_MARGIN * cw_volute_base_radius(volute) * 1e3,
        cw_volute_has_corners(volute) ? "its corners" : "a circle", room_by(volute));
  }
done:
  return status;
}

// Spiral and tongue with the arcs' angles as they are.
static CwStatus design_spiral(CwVolute *volute) {
  CwStatus status = CW_OK;
  CW_TRY(solve_spiral(volute));
  double x[3];
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, 0), 0, x, NULL, NULL);
  volute->throat_width = x[0] - volute->inner_wall_x;
  const int tongue = !isnan(volute->tip_angle) && !isnan(volute->throat_area) && !isnan(volute->throat_width);
  if (!tongue) could_help(volute, CW_VOLUTE_WIDER_SPIRAL);
  CW_REQUIRE(tongue, CW_ERR_DESIGN,
             "volute: no tongue of radius %g mm fits this spiral; lower tongue_radius_mm or raise throat_area_mm2",
             volute->input.tongue_radius * 1e3);
  if (volute->throat_width <= LEAST_THROAT * volute->input.tongue_radius) could_help(volute, CW_VOLUTE_THINNER_TONGUE);
  CW_TRY(check_sections(volute));
  CW_TRY(check_tongue(volute));
done:
  return status;
}

// A slim spiral has no room for a circle that touches both side walls: its arc then ends sooner, at last everywhere as
// at the tongue.
static CwStatus design_circle(CwVolute *volute) {
  const double touching = volute->end_half_angle, least = volute->arc_half_angle, step = M_PI / 18;
  for (int i = 0; touching - i * step > least - step; i++) {
    volute->end_half_angle = fmax(least, touching - i * step);
    if (design_spiral(volute) == CW_OK) return CW_OK;
    cw_fail_clear();
  }
  volute->end_half_angle = touching;
  return design_spiral(volute);
}

// Spiral and tongue with this angle of the arc at the tongue.
static CwStatus design_with_arc(double arc, CwVolute *volute) {
  volute->arc_half_angle = volute->end_half_angle = arc;
  volute->help = CW_VOLUTE_OTHER_INPUT;
  const int circle = volute->input.section == CW_SECTION_CIRCLE;
  if (circle || cw_volute_has_corners(volute)) volute->end_half_angle = 0.5 * M_PI + volute->input.side_wall_angle;
  volute->law_start = cw_volute_law(volute, cw_volute_base_radius(volute) * (1 + START_MARGIN), arc);
  return circle ? design_circle(volute) : design_spiral(volute);
}

// Whether the tip lies farther from the spiral's start than the given tongue does.
static int tip_is_beyond(const CwVolute *volute) {
  const CwVoluteInput *in = &volute->input;
  return (!isnan(in->tongue_gap) &&
          gap_of(volute) > in->tongue_gap + CW_VOLUTE_TONGUE_SLACK * cw_volute_base_radius(volute)) ||
         (!isnan(in->tongue_angle) && volute->tip_angle > in->tongue_angle + CW_VOLUTE_TONGUE_SLACK);
}

// Flatter arcs bring the tip nearer to a given tongue: the least flat one that reaches it, or else the flattest.
static CwStatus design_with_flatter_arc(double least, CwVolute *volute) {
  CwStatus status = CW_OK;
  CW_TRY(design_with_arc(least, volute));
  const CwVolute flattest = *volute;
  if (tip_is_beyond(volute)) goto done;
  for (double arc = ARC_HALF_ANGLE - ARC_STEP; arc > least; arc -= ARC_STEP) {
    if (design_with_arc(arc, volute) == CW_OK && !tip_is_beyond(volute)) goto done;
    cw_fail_clear();
  }
  *volute = flattest;
done:
  return status;
}

CwStatus cw_volute_design(const CwVoluteInput *input, CwVolute *volute) {
  CwStatus status = CW_OK;
  memset(volute, 0, sizeof *volute);
  volute->input = *input;
  if (input->section == CW_SECTION_RECTANGLE) volute->input.side_wall_angle = 0;
  CW_TRY(check_input(&volute->input));
  const double least = fmax(LEAST_ARC, LEAST_CORNER - 0.5 * M_PI + volute->input.side_wall_angle);
  status = design_with_arc(ARC_HALF_ANGLE, volute);
  if ((status == CW_OK || status == CW_ERR_DESIGN) && least < ARC_HALF_ANGLE && tip_is_beyond(volute)) {
    CwVolute flatter = *volute;
    if (design_with_flatter_arc(least, &flatter) == CW_OK) {
      status = CW_OK;
      *volute = flatter;
    }
    if (status == CW_OK) cw_fail_clear();
  }
  CW_TRY(status);
  volute->help = CW_VOLUTE_OTHER_INPUT; // of the diffuser

  cw_volute_side_line(volute);
  CW_TRY(cw_volute_diffuser(volute));
done:
  return status;
}
