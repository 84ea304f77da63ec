// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/rotor_volume.h"

#include <math.h>

#include "geometry/blade.h"
#include "geometry/meridian.h"
#include "geometry/root_fillet_size.h"

enum { SPANS = 8, POINTS = 160, OUTLINE = 4 * POINTS };

// Hub and shroud, with their derivatives, at even steps of q and half-way between them.
enum { STEPS = 240 };
static const double first_q = -0.1, last_q = 1.1;
typedef struct {
  double hub[2 * STEPS + 1][2], hub_by_q[2 * STEPS + 1][2], shroud[2 * STEPS + 1][2], shroud_by_q[2 * STEPS + 1][2];
} Walls;

static void fill_walls(const CwMeridian *meridian, Walls *walls) {
  for (int i = 0; i <= 2 * STEPS; i++) {
    const double q = first_q + (last_q - first_q) * i / (2 * STEPS);
    cw_meridian_blade_point(meridian, 0, q, walls->hub[i], walls->hub_by_q[i]);
    cw_meridian_blade_point(meridian, 1, q, walls->shroud[i], walls->shroud_by_q[i]);
  }
}

// Integral of r |M_q x M_s| dq at a span, and its rate: a blade's volume is the integral over its outline of the
// former times d theta (Green), and over the span.
typedef struct {
  double integral[STEPS + 1], rate[STEPS + 1];
} Swept;

static void fill_swept(const Walls *walls, double s, Swept *swept) {
  double rate[2 * STEPS + 1];
  for (int i = 0; i <= 2 * STEPS; i++) {
    const double *h = walls->hub[i], *c = walls->shroud[i];
    double x[2], dx[2];
    for (int k = 0; k < 2; k++) {
      x[k] = (1 - s) * h[k] + s * c[k];
      dx[k] = (1 - s) * walls->hub_by_q[i][k] + s * walls->shroud_by_q[i][k];
    }
    rate[i] = x[0] * fabs(dx[0] * (c[1] - h[1]) - dx[1] * (c[0] - h[0]));
  }
  const double step = (last_q - first_q) / STEPS;
  swept->integral[0] = 0;
  for (int i = 0; i <= STEPS; i++) {
    swept->rate[i] = rate[2 * i];
    if (i > 0)
      swept->integral[i] = swept->integral[i - 1] + step / 6 * (rate[2 * i - 2] + 4 * rate[2 * i - 1] + rate[2 * i]);
  }
}

// Between the steps by Hermite's cubic.
static double swept_at(const Swept *swept, double q) {
  const double step = (last_q - first_q) / STEPS, place = (q - first_q) / step;
  const int i = place < 0 ? 0 : place >= STEPS ? STEPS - 1 : (int)place;
  const double f = place - i, g = 1 - f;
  return g * g * (1 + 2 * f) * swept->integral[i] + f * f * (1 + 2 * g) * swept->integral[i + 1] +
         step * f * g * (g * swept->rate[i] - f * swept->rate[i + 1]);
}

// The outline of a section from the suction side's end over the leading edge and the pressure side and along the
// trailing edge; bevels begin where they do on the section `middle`.
static void outline(const CwDesign *design, const CwBladeSection *section, const CwBladeSection *middle,
                    CwBladePoint point[OUTLINE]) {
  const CwTrailingEdge edge = design->trailing_edge;
  const int bevelled = edge == CW_EDGE_BEVELLED || edge == CW_EDGE_SHARP;
  const double begin = bevelled ? cw_blade_bevel_begin(middle, edge, design->trailing_edge_bevel) : section->end;
  for (int i = 0; i < POINTS; i++) {
    const double f = (double)i / POINTS, g = f * f;
    point[i] = cw_blade_side(section, CW_BLADE_SUCTION, begin + (section->nose - begin) * f);
    point[POINTS + i] = cw_blade_leading_edge(section, M_PI * (f - 0.5));
    point[2 * POINTS + i] =
        cw_blade_side(section, CW_BLADE_PRESSURE, section->nose + (section->end - section->nose) * (0.4 * f + 0.6 * g));
    if (edge == CW_EDGE_ROUNDED)
      point[3 * POINTS + i] = cw_blade_trailing_edge(section, M_PI * (0.5 - f));
    else
      point[3 * POINTS + i] = cw_blade_side(section, CW_BLADE_PRESSURE, section->end);
  }
  if (edge == CW_EDGE_BEVELLED) // the far end of the cut; the outline closes with the facet
    point[OUTLINE - 1] = (CwBladePoint){1, cw_blade_bevel_theta(middle, begin) - middle->shift + section->shift};
}

// Volume of a section per unit of span.
static double section_volume(const Walls *walls, double s, const CwBladePoint point[OUTLINE]) {
  double f[OUTLINE], sum = 0;
  Swept swept;
  fill_swept(walls, s, &swept);
  for (int i = 0; i < OUTLINE; i++) f[i] = swept_at(&swept, point[i].q);
  for (int i = 0; i < OUTLINE; i++) {
    const int next = (i + 1) % OUTLINE;
    sum += 0.5 * (f[i] + f[next]) * (point[next].theta - point[i].theta);
  }
  return fabs(sum);
}

// Volume of the fillets on one wall: their section between both tangents and the arc, R^2 (cot(alpha/2) -
// (pi - alpha)/2), along the crease.
static double fillet_volume(const CwDesign *design, const CwMeridian *meridian, const CwBladeSection *on,
                            const CwBladeSection *off, const CwBladePoint point[OUTLINE]) {
  double sum = 0;
  for (int i = 0; i < OUTLINE; i++) {
    const CwBladePoint *a = &point[i], *b = &point[(i + 1) % OUTLINE];
    const double q = 0.5 * (a->q + b->q);
    const CwFilletPlace place = cw_root_fillet_place(meridian, on, off, q);
    const double m = (b->q - a->q) * place.speed, t = (b->theta - a->theta) * place.radius, length = hypot(m, t);
    if (length == 0) continue;
    // The outline runs with the fluid on its left.
    const double alpha = cw_root_fillet_angle(&place, -t / length, m / length);
    const double tangent = cw_root_fillet_length(design, on, q, alpha), radius = tangent * tan(alpha / 2);
    sum += length * radius * (tangent - 0.5 * radius * (M_PI - alpha));
  }
  return sum;
}

CwStatus cw_rotor_volume(const CwDesign *design, double *volume) {
  CwStatus status = CW_OK;
  CwMeridian meridian;
  CwBladeSection section[SPANS + 1];
  CwBladePoint point[OUTLINE];
  Walls walls;
  double blades = 0;
  CW_TRY(cw_meridian_make(design, &meridian));
  fill_walls(&meridian, &walls);
  for (int kind = 0; kind < (design->splitter_start > 0 ? 2 : 1); kind++) {
    for (int j = 0; j <= SPANS; j++) {
      CW_TRY(cw_blade_section(design, &meridian, (double)j / SPANS, &section[j]));
      if (kind == 1) section[j] = cw_blade_splitter(design, &section[j]);
    }
    for (int j = 0; j <= SPANS; j++) {
      const int end = j == 0 || j == SPANS;
      outline(design, &section[j], &section[SPANS / 2], point);
      blades += section_volume(&walls, section[j].span, point) * (end ? 1 : j % 2 ? 4 : 2) / (3.0 * SPANS);
      if (end && design->root_fillet_radius > 0)
        blades += fillet_volume(design, &meridian, &section[j], &section[j == 0 ? 1 : SPANS - 1], point);
    }
  }
  *volume = cw_meridian_volume(&meridian) - design->blade_count * blades;
done:
  return status;
}
