// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/meridian_passage.h"

#include <math.h>

// Along the sum of both walls' directions: how far the shroud's point lies ahead of the hub's at t. Falls with t.
static double ahead(const CwMeridianCurve *hub, double t, const double shroud[2], const double along[2],
                    double point[2]) {
  double dx[2];
  cw_meridian_point(hub, t, point, dx);
  const double speed = hypot(dx[0], dx[1]);
  return (shroud[0] - point[0]) * (dx[0] / speed + along[0]) + (shroud[1] - point[1]) * (dx[1] / speed + along[1]);
}

// The hub's parameter of the line from a point of the shroud, by the Illinois rule; `point`: there.
static double hub_parameter(const CwMeridianCurve *hub, double least, const double shroud[2], const double along[2],
                            double point[2]) {
  double a = least, b = 1, fa = ahead(hub, a, shroud, along, point), fb = ahead(hub, b, shroud, along, point);
  if (fa <= 0 || fb >= 0) { // before the hub's begin, or behind its end
    const double t = fa <= 0 ? a : b;
    ahead(hub, t, shroud, along, point);
    return t;
  }
  double t = a;
  for (int i = 0, side = 0; i < 60; i++) {
    t = (a * fb - b * fa) / (fb - fa);
    const double f = ahead(hub, t, shroud, along, point);
    if (fabs(f) < 1e-13 || b - a < 1e-14) break;
    if (f > 0) {
      a = t;
      fa = f;
      if (side > 0) fb /= 2;
      side = 1;
    } else {
      b = t;
      fb = f;
      if (side < 0) fa /= 2;
      side = -1;
    }
  }
  return t;
}

static double parameter_at_radius(const CwMeridianCurve *shroud, double radius) {
  double low = 0, high = 1, x[2];
  for (int i = 0; i < 50; i++) {
    const double middle = 0.5 * (low + high);
    cw_meridian_point(shroud, middle, x, NULL);
    *(x[0] < radius ? &low : &high) = middle;
  }
  return low;
}

// The line from the shroud's point at t, to the hub from its parameter `least` on; returns the hub's parameter.
static double line_from(const CwMeridianCurve *hub, const CwMeridianCurve *shroud, double t, double least,
                        CwPassageStation *s) {
  double dx[2];
  cw_meridian_point(shroud, t, s->shroud, dx);
  const double speed = hypot(dx[0], dx[1]), along[2] = {dx[0] / speed, dx[1] / speed};
  const double on_hub = hub_parameter(hub, least, s->shroud, along, s->hub);
  s->height = hypot(s->hub[0] - s->shroud[0], s->hub[1] - s->shroud[1]);
  s->area = M_PI * (s->hub[0] + s->shroud[0]) * s->height;
  return on_hub;
}

static const double BEFORE = -0.2; // the hub's parameter before its begin, where it is nearly a cylinder

void cw_meridian_passage(const CwMeridianCurve *hub, const CwMeridianCurve *shroud, double outlet_radius, int count,
                         CwPassageStation *station) {
  const double end = parameter_at_radius(shroud, outlet_radius);
  double t = BEFORE;
  for (int i = 0; i < count; i++) {
    CwPassageStation *s = &station[i];
    t = line_from(hub, shroud, end * i / (count - 1), t, s);
    const CwPassageStation *before = i > 0 ? s - 1 : s;
    s->length = before->length * (i > 0) + 0.5 * hypot(s->hub[0] + s->shroud[0] - before->hub[0] - before->shroud[0],
                                                       s->hub[1] + s->shroud[1] - before->hub[1] - before->shroud[1]);
  }
}

CwPassageStation cw_meridian_passage_at(const CwMeridianCurve *hub, const CwMeridianCurve *shroud, double radius) {
  CwPassageStation station = {.length = 0};
  line_from(hub, shroud, parameter_at_radius(shroud, radius), BEFORE, &station);
  return station;
}

double cw_passage_reversal(const CwPassageStation *station, int count) {
  const double trend = station[count - 1].area >= station[0].area ? 1 : -1;
  double reached = station[0].area, reversal = 0;
  for (int i = 1; i < count; i++) {
    const double area = station[i].area;
    if (trend * (area - reached) > 0) reached = area;
    reversal = fmax(reversal, trend * (reached - area) / reached);
  }
  return reversal;
}
