// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/volute_diffuser.h"

#include <math.h>

#include "geometry/root.h"
#include "geometry/standard_bore.h"
#include "geometry/volute_section.h"
#include "geometry/volute_tongue.h"
#include "pipeline/vec.h"

static const double PIPE_SPEED = 4;            // m/s, economic in pipes
static const double PIPE_LENGTH = 2;           // of the straight pipe behind, in outlet diameters
static const double LARGEST_ANGLE = M_PI / 6;  // of the equivalent cone
static const double LEAST_LENGTH = 0.5;        // of the outlet's radius, where the length is left open
static const double LEAST_LENGTH_RADIAL = 4;   // the same of a radial discharge
static const double LEAST_BEND_RADIUS = 1.5;   // of the axis of a radial discharge, in radii of the outlet
static const double LARGEST_BEND = 0.6 * M_PI; // rad
static const double LARGEST_TURN = 0.6;        // rad, outward from the throat's direction
static const double LEAST_WALL = 0.8;          // of the tongue's radius, between diffuser and spiral
static const double BENT_TANGENT = 0.85;       // of a bent line's arc: less than 1, so that the bore does not shrink
static const double LARGEST_NARROWING = 0.1;   // of the throat's width
static const double STEP = 1 + 1e-9;           // past a bore, so that the next larger one is found
static const double SLACK = 1e-9;              // of values that went through other units

// m as tenths of a mm, not less.
static double tenths_of_mm(double least) {
  return ceil(1e4 * (1 - SLACK) * least) / 10;
}

CwDiffuserLines cw_diffuser_lines(const CwVolute *volute) {
  double x[3], x_phi[3];
  CwDiffuserLines lines = {.tangent = CW_DIFFUSER_TANGENT * volute->diffuser_length, .turning = 1};
  const double lean[2] = {volute->throat_lean, volute->discharge_lean};
  const int radial = volute->input.discharge == CW_DISCHARGE_RADIAL;
  if (radial) lines.bend = fmax(0, lean[0] - lean[1]);
  lines.axis[0] = -sin(lean[0]);
  lines.axis[1] = cos(lean[0]);
  lines.down[0] = -sin(lean[1]);
  lines.down[1] = cos(lean[1]);
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, 0), 0, x, x_phi, NULL);
  const double closing = -x_phi[0] / x_phi[1]; // of the throat's width by length
  const double tangent = (lines.bend > 0 ? BENT_TANGENT : CW_DIFFUSER_TANGENT) * volute->diffuser_length;
  const double narrowing = closing * tangent / (LARGEST_NARROWING * volute->throat_width);
  // The largest values of t (1 - t)^2 and t (1 - t)^3.
  if (narrowing * 4 / 27 > 1) lines.turning = fmin(1, 256.0 / 27 / narrowing);
  return lines;
}

void cw_diffuser_line(const CwDiffuserLines *lines, const double start[3], const double leaving[3], const double end[3],
                      double v, double point[3]) {
  const double w = 1 - v, t = v / lines->turning, bend = lines->bend;
  const double chord = cw_distance(end, start);
  const double bent = bend > 0 ? BENT_TANGENT * chord * 0.5 * bend / sin(0.5 * bend) : 0;
  const double whole = cw_norm(leaving);
  for (int i = 0; i < 3; i++) {
    const double own = bent > 0 ? leaving[i] * (bent / whole) : leaving[i], tangent = bent > 0 ? bent : lines->tangent;
    const double first = lines->turning < 1 ? (i < 2 ? tangent * lines->axis[i] : 0) : own;
    const double last = i < 2 ? tangent * lines->down[i] : 0;
    point[i] =
        start[i] * (w * w * (1 + 2 * v)) + first * (w * w * v) + end[i] * (v * v * (1 + 2 * w)) - last * (v * v * w);
    if (lines->turning < 1 && t < 1) point[i] += (own - first) * lines->turning * t * pow(1 - t, 3);
  }
}

static double bore_ratio(double bore, double throat_area) {
  return M_PI / 4 * bore * bore / throat_area;
}

double cw_diffuser_bore(double flow_rate, double throat_area) {
  double bore = cw_standard_bore(sqrt(CW_DIFFUSER_LEAST_RATIO * throat_area * 4 / M_PI));
  for (;;) {
    const double next = cw_standard_bore(bore * STEP);
    if (flow_rate / (M_PI / 4 * bore * bore) <= PIPE_SPEED || bore_ratio(next, throat_area) > CW_DIFFUSER_LARGEST_RATIO)
      return bore;
    bore = next;
  }
}

// Where the diffuser ends that leaves the throat's middle (x, y) along its lean and turns by `bend` to the
// right on a circle.
static void end_diffuser(CwVolute *volute, double x, double y, double bend) {
  double chord = volute->diffuser_length * (bend > 0 ? sin(bend / 2) / (bend / 2) : 1);
  volute->discharge_lean = volute->throat_lean - bend;
  volute->outlet_x = x - chord * sin(volute->throat_lean - bend / 2);
  volute->outlet_y = y + chord * cos(volute->throat_lean - bend / 2);
}

static CwStatus set_bore_and_length(CwVolute *volute) {
  CwStatus status = CW_OK;
  CwVoluteInput *in = &volute->input;
  if (!isnan(in->diffuser_area_ratio))
    in->outlet_diameter = sqrt(in->diffuser_area_ratio * volute->throat_area * 4 / M_PI);
  else if (isnan(in->outlet_diameter))
    in->outlet_diameter = cw_diffuser_bore(in->pipe_flow_rate, volute->throat_area);
  if (isnan(in->discharge_pipe_length)) in->discharge_pipe_length = PIPE_LENGTH * in->outlet_diameter;
  const double radius = 0.5 * in->outlet_diameter, throat_radius = sqrt(volute->throat_area / M_PI);
  CW_REQUIRE(radius > throat_radius, CW_ERR_DESIGN,
             "volute: outlet_diameter_mm is %g mm, less than the throat's equal-area diameter %.2f mm; raise "
             "it, or lower throat_area_mm2 (%.0f mm2)",
             2e3 * radius, 2e3 * throat_radius, volute->throat_area * 1e6);
  volute->diffuser_length = in->diffuser_length;
  if (isnan(in->diffuser_length))
    volute->diffuser_length =
        fmax((radius - throat_radius) / tan(0.5 * in->diffuser_angle),
             (in->discharge == CW_DISCHARGE_RADIAL ? LEAST_LENGTH_RADIAL : LEAST_LENGTH) * radius);
  volute->diffuser_angle = 2 * atan((radius - throat_radius) / volute->diffuser_length);
  volute->diffuser_area_ratio = radius * radius / (throat_radius * throat_radius);
  CW_REQUIRE(volute->diffuser_angle <= (1 + SLACK) * LARGEST_ANGLE, CW_ERR_DESIGN,
             "volute: diffuser_length_mm %g mm opens the diffuser by %.1f deg; allowed: at most %.0f deg (at "
             "least %.1f mm)",
             volute->diffuser_length * 1e3, volute->diffuser_angle / CW_DEGREE, LARGEST_ANGLE / CW_DEGREE,
             tenths_of_mm((radius - throat_radius) / tan(0.5 * LARGEST_ANGLE)));
done:
  return status;
}

// The inner half of the diffuser's wall above z = 0 as the solid has it: lines from the throat's contour to the
// outlet's circle.
typedef struct {
  double throat_half_width, outer_x, lean; // at the flank; of the outer corner; dx/dy of the wall there
  double inner_angle, outer_angle;         // where the corners meet the circle, from the outer side on
} InnerWall;

static InnerWall inner_wall(const CwVolute *volute) {
  enum { PIECES = 16 };
  const double k = volute->arc_half_angle, y = volute->throat_y;
  double corner[3], along[3], before[3], x[3], outer_length = 0;
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, k), k, corner, along, NULL);
  for (int i = 0; i <= PIECES; i++) {
    const double psi = k * i / PIECES;
    cw_volute_wall_point(volute, cw_volute_throat_angle(volute, psi), psi, x, NULL, NULL);
    if (i > 0) outer_length += hypot(x[0] - before[0], x[2] - before[2]);
    for (int j = 0; j < 3; j++) before[j] = x[j];
  }
  InnerWall wall = {cw_volute_half_width(volute, hypot(volute->inner_wall_x, y)), corner[0], along[0] / along[1], 0, 0};
  const double side = hypot(corner[0] - volute->inner_wall_x, corner[2] - wall.throat_half_width);
  const double whole = wall.throat_half_width + outer_length + side;
  wall.inner_angle = M_PI * (1 - wall.throat_half_width / whole);
  wall.outer_angle = M_PI * outer_length / whole;
  return wall;
}

// Point of the line that begins on the flank (along < 1: its share of the way from z = 0 to the corner) or on the side
// (along - 1: its share of the way to the outer corner), at the share s of its length.
static void inner_wall_point(const CwVolute *volute, const CwDiffuserLines *lines, const InnerWall *wall, double along,
                             double s, double point[3]) {
  const double side = fmax(0, along - 1), up = fmin(1, along), y = volute->throat_y;
  const double x = volute->inner_wall_x + side * (wall->outer_x - volute->inner_wall_x), r = hypot(x, y);
  const double slope = tan(volute->input.side_wall_angle) * (x * wall->lean * side + y) / r;
  const double tangent = lines->tangent;
  const double start[3] = {x, y, up * cw_volute_half_width(volute, r)};
  const double leaving[3] = {tangent * wall->lean * side, tangent, tangent * up * slope};
  const double lean = volute->discharge_lean, radius = 0.5 * volute->input.outlet_diameter;
  const double angle = M_PI + up * (wall->inner_angle - M_PI) + side * (wall->outer_angle - wall->inner_angle);
  const double end[3] = {volute->outlet_x + radius * cos(angle) * cos(lean),
                         volute->outlet_y + radius * cos(angle) * sin(lean), radius * sin(angle)};
  cw_diffuser_line(lines, start, leaving, end, s, point);
}

// Least radial distance of the diffuser's inner wall from the spiral's outer wall, m.
static double clearance(const CwVolute *volute) {
  enum { LINES = 8, POINTS = 16 };
  const InnerWall wall = inner_wall(volute);
  const CwDiffuserLines lines = cw_diffuser_lines(volute);
  double least = HUGE_VAL;
  for (int i = 0; i <= 2 * LINES; i++)
    for (int j = 0; j <= POINTS; j++) {
      double p[3];
      inner_wall_point(volute, &lines, &wall, (double)i / LINES, (double)j / POINTS, p);
      const CwVoluteSection section = cw_volute_section(volute, atan2(p[1], p[0]));
      if (p[2] > section.kink_height + volute->input.tongue_radius) continue;
      least = fmin(least, hypot(p[0], p[1]) - cw_volute_wall_radius(&section, fmin(p[2], section.kink_height)));
    }
  return least;
}

typedef struct {
  const CwVolute *volute; // its outlet lies at the throat's middle
  double value;           // m
} Context;

// Ends a straight diffuser that is turned outward from the throat's direction, away from the spiral.
static void turn_outward(CwVolute *volute, double turn) {
  volute->throat_lean -= turn;
  end_diffuser(volute, volute->outlet_x, volute->outlet_y, 0);
}

static double clearance_excess(double turn, const void *context) {
  const Context *c = context;
  CwVolute trial = *c->volute;
  turn_outward(&trial, turn);
  return clearance(&trial) - c->value;
}

// Distance of the discharge's axis from the pump's, to the left of it.
static double bend_excess(double bend, const void *context) {
  CwVolute trial = *((const Context *)context)->volute;
  end_diffuser(&trial, trial.outlet_x, trial.outlet_y, bend);
  return trial.outlet_x * cos(trial.discharge_lean) + trial.outlet_y * sin(trial.discharge_lean);
}

static CwStatus end_radial(CwVolute *volute) {
  CwStatus status = CW_OK;
  const double least = LEAST_BEND_RADIUS * 0.5 * volute->input.outlet_diameter;
  const Context context = {.volute = volute};
  const double bend = cw_root_find(bend_excess, &context, 1e-3, LARGEST_BEND);
  CW_REQUIRE(volute->diffuser_length >= (1 - SLACK) * least * bend, CW_ERR_DESIGN,
             "volute: diffuser_length_mm %g mm is too short for a radial discharge, which bends it by %.0f deg; "
             "allowed: at least %.1f mm",
             volute->diffuser_length * 1e3, bend / CW_DEGREE, tenths_of_mm(least * bend));
  end_diffuser(volute, volute->outlet_x, volute->outlet_y, bend);
done:
  return status;
}

// A wide outlet would run into the spiral behind the tongue; its axis then turns outward until the wall between them is
// nearly as thick as the tongue.
static void end_tangential(CwVolute *volute) {
  const Context context = {.volute = volute, .value = LEAST_WALL * volute->input.tongue_radius};
  double turn = 0;
  if (clearance_excess(0, &context) < 0) turn = cw_root_find(clearance_excess, &context, 0, LARGEST_TURN);
  turn_outward(volute, isnan(turn) ? LARGEST_TURN : turn);
}

CwStatus cw_volute_diffuser(CwVolute *volute) {
  CwStatus status = CW_OK;
  double x[3], x_phi[3];
  CW_TRY(set_bore_and_length(volute));
  // Midway between the walls at the throat, along the mean of their directions there.
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, 0), 0, x, x_phi, NULL);
  volute->throat_lean = 0.5 * atan2(-x_phi[0], x_phi[1]);
  volute->outlet_x = 0.5 * (volute->inner_wall_x + x[0]);
  volute->outlet_y = volute->throat_y;
  if (volute->input.discharge == CW_DISCHARGE_RADIAL)
    CW_TRY(end_radial(volute));
  else
    end_tangential(volute);
done:
  return status;
}
