// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/volute_tongue.h"

#include <math.h>

#include "geometry/root.h"
#include "geometry/volute_section.h"

// Above the kink's level the nose's centre line levels out over this height, in nose radii.
static const double LEVEL_OUT = 1.0;

typedef struct {
  const CwVolute *volute;
  double psi, level, beta;
} Context;

void cw_volute_contact_circle(const CwVolute *volute, double phi, double psi, double centre[2], double normal[2]) {
  double x[3], a[3], b[3];
  cw_volute_wall_point(volute, phi, psi, x, a, b);
  // a x b points out of the fluid: phi runs with the flow, psi upward.
  double nx = a[1] * b[2] - a[2] * b[1], ny = a[2] * b[0] - a[0] * b[2], length = hypot(nx, ny);
  normal[0] = nx / length;
  normal[1] = ny / length;
  for (int i = 0; i < 2; i++) centre[i] = x[i] + volute->input.tongue_radius * normal[i];
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
  c.psi = cw_volute_section_parameter(c.volute, &section, c.level);
  return contact_excess(phi, &c);
}

double cw_volute_contact_angle(const CwVolute *volute, double psi) {
  if (fabs(psi) >= volute->arc_half_angle) return volute->start_angle;
  Context context = {.volute = volute, .psi = fabs(psi)};
  return cw_root_find(contact_excess, &context, volute->start_angle, 0.45 * M_PI);
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
  double phi = cw_root_find(contact_at_level_excess, &context, volute->start_angle, volute->tip_angle + 1e-9);
  if (isnan(phi)) // along a wall parallel to the axis all levels touch at the tip's angle, but for rounding
    phi = cw_root_find(contact_at_level_excess, &context, volute->start_angle - 1e-3, volute->tip_angle + 1e-3);
  CwVoluteSection section = cw_volute_section(volute, phi);
  double centre[2], normal[2];
  cw_volute_contact_circle(volute, phi, cw_volute_section_parameter(volute, &section, w), centre, normal);
  return centre[1];
}

void cw_volute_side_line(CwVolute *volute) {
  double centre[2], normal[2];
  volute->side_level = cw_volute_section(volute, volute->start_angle).kink_height;
  cw_volute_contact_circle(volute, volute->start_angle, volute->arc_half_angle, centre, normal);
  volute->side_centre_y = centre[1];
  // One-sided, of second order: above this level there is no wall.
  double step = 1e-4 * volute->side_level;
  double near = cw_volute_nose_y(volute, volute->side_level - step);
  double far = cw_volute_nose_y(volute, volute->side_level - 2 * step);
  volute->side_centre_slope = (3 * centre[1] - 4 * near + far) / (2 * step);
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
  return cw_root_find(nose_height_excess, &context, 0.8 * volute->side_level, 2 * volute->side_level);
}

static double throat_excess(double phi, const void *context) {
  const Context *c = context;
  double x[3];
  cw_volute_wall_point(c->volute, phi, c->psi, x, NULL, NULL);
  return x[1] - c->volute->throat_y;
}

double cw_volute_throat_angle(const CwVolute *volute, double psi) {
  Context context = {.volute = volute, .psi = psi};
  return cw_root_find(throat_excess, &context, 2 * M_PI, 2.4 * M_PI);
}
