// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/root_fillet_size.h"

#include <math.h>

static const double room_share = 0.4;    // of the room between D2 and the interface that the foot may take
static const double narrows_from = 0.85; // share of the blade's length

static double place_on_blade(const CwBladeSection *section, double q) {
  return fmin(1, fmax(0, (q - section->start) / (1 - section->start)));
}

CwFilletPlace cw_root_fillet_place(const CwMeridian *meridian, const CwBladeSection *on, const CwBladeSection *off,
                                   double q) {
  const double p = place_on_blade(on, q), inside = on->start + p * (1 - on->start);
  double x[2], dx[2], y[2];
  CwFilletPlace place;
  cw_meridian_blade_point(meridian, on->span, q, x, dx);
  place.speed = hypot(dx[0], dx[1]);
  place.radius = x[0];
  cw_meridian_blade_point(meridian, on->span, inside, x, dx);
  cw_meridian_blade_point(meridian, off->span, inside, y, NULL);
  const double speed = hypot(dx[0], dx[1]);
  const double up = fabs((y[0] - x[0]) * dx[1] - (y[1] - x[1]) * dx[0]) / speed;
  place.height = up / fabs(off->span - on->span);
  place.lean[0] = ((y[0] - x[0]) * dx[0] + (y[1] - x[1]) * dx[1]) / speed / up;
  place.lean[1] = x[0] * (cw_blade_theta(off, p) - cw_blade_theta(on, p)) / up;
  return place;
}

double cw_root_fillet_angle(const CwFilletPlace *place, double normal_m, double normal_t) {
  return fmax(M_PI / 4, atan2(1, place->lean[0] * normal_m + place->lean[1] * normal_t));
}

double cw_root_fillet_length(const CwDesign *design, const CwBladeSection *on, double q, double alpha) {
  const double full = design->root_fillet_radius / tan(alpha / 2);
  const double room = room_share * (design->interface_radius - design->outlet_diameter / 2);
  const double narrow = cw_smooth_step((place_on_blade(on, q) - narrows_from) / (1 - narrows_from));
  return full + narrow * (fmin(full, room) - full);
}
