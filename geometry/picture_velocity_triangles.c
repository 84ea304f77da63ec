// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/picture.h"

static const double NAME = 60, ROOM = 24; // px: width of an arrow's name, height between two arrows that it fits into

// One triangle: u from left to right, c from its left end, w from its right end to the same apex. The name of u stands
// below, that of c before it. That of w stands above it; with swirl, where the line without slip runs there, between w
// and u, or, where that is too flat, behind both.
static void triangle(CwPicture *picture, double left, double base, double scale, const char *where,
                     const CwTriangle *t) {
  const double x1 = left + scale * t->u, xa = left + scale * t->c_u, ya = base - scale * t->c_m;
  cw_picture_text(picture, CW_TEXT_LEFT, left, ya - 30, "%s", where);
  cw_picture_arrow(picture, CW_STROKE_WALL, left, base, x1, base);
  cw_picture_arrow(picture, CW_STROKE_FLOW, left, base, xa, ya);
  cw_picture_arrow(picture, CW_STROKE_BLADE, x1, base, xa, ya);
  cw_picture_text(picture, CW_TEXT_MIDDLE, 0.5 * (left + x1), base + 20, "u = %.2f", t->u);
  cw_picture_text(picture, CW_TEXT_RIGHT, 0.5 * (left + xa) - 8, 0.5 * (base + ya) - 4, "c = %.2f", t->c);
  double x = 0.5 * (x1 + xa) + 8, y = 0.5 * (base + ya) - 8;
  if (xa > left + 1) {
    cw_picture_segment(picture, CW_STROKE_THIN, xa, ya, xa, base);
    x = (base - ya) * (1 - (6 + NAME) / (x1 - xa)) > ROOM ? xa + 6 : x1 + 12;
    y = base - 8;
  }
  cw_picture_text(picture, CW_TEXT_LEFT, x, y, "w = %.2f", t->w);
}

// w as it would be without slip, with the same u and c_m behind the blades; between them, where w runs along the blade,
// c_m is greater by the blockage. The gap between both apexes is the slip (1 - gamma) u.
static void without_slip(CwPicture *picture, double left, double base, double scale, const CwTriangle *t,
                         double blockage) {
  const double c_u = t->u - blockage * t->c_m / tan(t->blade_angle);
  const double x1 = left + scale * t->u, xa = left + scale * t->c_u, xb = left + scale * c_u,
               ya = base - scale * t->c_m;
  cw_picture_segment(picture, CW_STROKE_AXIS, x1, base, xb, ya);
  cw_picture_segment(picture, CW_STROKE_AXIS, xa, ya, xb, ya);
  cw_picture_text(picture, CW_TEXT_MIDDLE, 0.5 * (xa + xb), ya - 8, "slip %.2f", c_u - t->c_u);
}

// The figures of a triangle as a row of the table.
static void row(CwPicture *picture, double y, const char *where, const CwTriangle *t) {
  const double values[] = {t->radius * 1e3,
                           t->u,
                           t->c_m,
                           t->c_u,
                           t->c,
                           t->w,
                           t->flow_angle * 180 / M_PI,
                           t->blade_angle * 180 / M_PI,
                           (t->blade_angle - t->flow_angle) * 180 / M_PI};
  cw_picture_text(picture, CW_TEXT_LEFT, 40, y, "%s", where);
  for (int i = 0; i < 9; i++)
    cw_picture_text(picture, CW_TEXT_RIGHT, 250 + 75 * i, y, i == 0 || i > 5 ? "%.1f" : "%.2f", values[i]);
}

CwStatus cw_picture_velocity_triangles(const CwDesign *design, const char *path) {
  CwStatus status = CW_OK;
  CwPicture picture = {0};
  static const char *const heads[] = {"r, mm", "u", "c_m", "c_u", "c", "w", "flow, deg", "blade, deg", "difference"};
  static const char *const inlets[] = {"inlet, hub", "inlet, mid-span", "inlet, shroud"};
  static const char *const outlets[] = {"outlet, hub", "outlet, mid-span", "outlet, shroud"};
  const CwTriangle *in = design->inlet_triangle, *out = design->outlet_triangle;
  // One scale for all: the outlet's triangle is 560 px wide, less where the three of the inlet want the room.
  const double scale = fmin(560 / out[1].u, (860 - 70 - 2 * 85) / (in[0].u + in[1].u + in[2].u));
  double highest = 0;
  for (int j = 0; j < CW_TRIANGLE_SPANS; j++) highest = fmax(highest, in[j].c_m);
  const double first = 100 + scale * highest, second = first + 100 + scale * out[1].c_m, table = second + 70;
  CW_TRY(cw_picture_begin(&picture, path, 940, table + 22 * 7 + 50));
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, 28,
                  "Velocity triangles, m/s, all to one scale; inlet with blockage and without swirl, outlet behind the "
                  "blades with slip");
  double left = 70;
  for (int j = 0; j < CW_TRIANGLE_SPANS; j++) {
    triangle(&picture, left, first, scale, inlets[j], &in[j]);
    left += scale * in[j].u + 85;
  }
  triangle(&picture, 70, second, scale, "outlet, mid-span; chain line: without slip", &out[1]);
  without_slip(&picture, 70, second, scale, &out[1], design->outlet_blockage);
  for (int i = 0; i < 9; i++) cw_picture_text(&picture, CW_TEXT_RIGHT, 250 + 75 * i, table, "%s", heads[i]);
  cw_picture_segment(&picture, CW_STROKE_THIN, 40, table + 8, 860, table + 8);
  for (int j = 0; j < CW_TRIANGLE_SPANS; j++) {
    row(&picture, table + 28 + 22 * j, inlets[j], &in[j]);
    row(&picture, table + 28 + 22 * (j + 3), outlets[j], &out[j]);
  }
  cw_picture_text(&picture, CW_TEXT_LEFT, 40, table + 22 * 7 + 20,
                  "slip factor %.3f (Wiesner %.3f, Pfleiderer %.3f), w2/w1 %.2f, predicted head %.2f m, asked %.2f m",
                  design->slip_factor, design->slip_factor_wiesner, design->slip_factor_pfleiderer,
                  design->diffusion_ratio, design->predicted_head, design->head);
  CW_TRY(cw_picture_end(&picture));
done:
  cw_picture_abandon(&picture);
  return status;
}
