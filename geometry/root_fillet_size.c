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

enum { PLACES = 40, NORMALS = 3 }; // along the blade; at a place: of both sides, and of the leading edge

// Adds what the fillets on one wall take of the blade's height. off: the section of a near span.
static void add_wall(const CwDesign *design, const CwMeridian *meridian, const CwBladeSection *on,
                     const CwBladeSection *off, double taken[PLACES + 1][NORMALS], CwFilletFit *fit) {
  const double step = 1.0 / PLACES;
  for (int i = 0; i <= PLACES; i++) {
    const double p = (double)i / PLACES, q = on->start + p * (1 - on->start);
    const double from = fmax(0, p - 0.5 * step), to = fmin(1, p + 0.5 * step);
    const CwFilletPlace place = cw_root_fillet_place(meridian, on, off, q);
    const double m = (to - from) * (1 - on->start) * place.speed;
    const double t = (cw_blade_theta(on, to) - cw_blade_theta(on, from)) * place.radius, length = hypot(m, t);
    const double normal[NORMALS][2] = {
        {-t / length, m / length}, {t / length, -m / length}, {-m / length, -t / length}};
    for (int k = 0; k < (i ? NORMALS - 1 : NORMALS); k++) {
      const double alpha = cw_root_fillet_angle(&place, normal[k][0], normal[k][1]);
      const double tangent = cw_root_fillet_length(design, on, q, alpha);
      taken[i][k] += tangent * sin(alpha) / place.height;
      fit->height_share = fmax(fit->height_share, taken[i][k]);
      fit->chord = fmin(fit->chord, 2 * cos(alpha / 2));
    }
  }
}

CwStatus cw_root_fillet_fit(const CwDesign *design, const CwMeridian *meridian, CwFilletFit *fit) {
  CwStatus status = CW_OK;
  static const double span[4] = {0, 0.25, 0.75, 1};
  CwBladeSection section[4];
  double taken[PLACES + 1][NORMALS] = {{0}};
  *fit = (CwFilletFit){0, INFINITY};
  for (int j = 0; j < 4; j++) CW_TRY(cw_blade_section(design, meridian, span[j], &section[j]));
  add_wall(design, meridian, &section[0], &section[1], taken, fit);
  add_wall(design, meridian, &section[3], &section[2], taken, fit);
done:
  return status;
}
