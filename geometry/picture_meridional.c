// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/meridian.h"
#include "geometry/picture.h"

enum { POINTS = 80 };

// From (r, z) in m to pixels: z to the right, r upward.
typedef struct {
  double scale, left, bottom, z0;
} Frame;

static void to_pixels(const Frame *frame, double r, double z, double pixel[2]) {
  pixel[0] = frame->left + frame->scale * (z - frame->z0);
  pixel[1] = frame->bottom - frame->scale * r;
}

static void draw_curve(CwPicture *picture, const Frame *frame, const CwMeridianCurve *curve) {
  double line[POINTS + 1][2], x[2];
  for (int i = 0; i <= POINTS; i++) {
    cw_meridian_point(curve, (double)i / POINTS, x, NULL);
    to_pixels(frame, x[0], x[1], line[i]);
  }
  cw_picture_line(picture, CW_STROKE_WALL, (const double(*)[2])line, POINTS + 1, 0);
}

static void draw_segment(CwPicture *picture, const Frame *frame, CwStroke stroke, double r0, double z0, double r1,
                         double z1) {
  double p[2], q[2];
  to_pixels(frame, r0, z0, p);
  to_pixels(frame, r1, z1, q);
  cw_picture_segment(picture, stroke, p[0], p[1], q[0], q[1]);
}

static void draw_nut(CwPicture *picture, const Frame *frame, const CwMeridian *m) {
  const double rn = m->hub.pole[0][0], z0 = m->hub.pole[0][1], rd = m->nut_disk_radius, ze = m->nut_end_z;
  double line[POINTS + 2][2];
  to_pixels(frame, m->shaft_radius, m->shaft_radius > 0 ? m->inlet_z : ze, line[0]);
  for (int i = 0; i <= POINTS; i++) {
    const double turn = M_PI / 2 * i / POINTS;
    to_pixels(frame, rd + (rn - rd) * sin(turn), z0 + (ze - z0) * cos(turn), line[i + 1]);
  }
  cw_picture_line(picture, CW_STROKE_WALL, (const double(*)[2])line, POINTS + 2, 0);
}

// The area between the leading and the trailing edge, as it stands in the section.
static void draw_blade(CwPicture *picture, const Frame *frame, const CwMeridian *m) {
  double line[2 * POINTS + 2][2], x[2];
  for (int i = 0; i <= POINTS; i++) {
    cw_meridian_blade_point(m, 0, (double)i / POINTS, x, NULL);
    to_pixels(frame, x[0], x[1], line[i]);
    cw_meridian_blade_point(m, 1, 1 - (double)i / POINTS, x, NULL);
    to_pixels(frame, x[0], x[1], line[POINTS + 1 + i]);
  }
  cw_picture_line(picture, CW_STROKE_BLADE, (const double(*)[2])line, 2 * POINTS + 2, 1);
}

static void label(CwPicture *picture, const Frame *frame, CwTextAlign align, double r, double z, double dx, double dy,
                  const char *name, double mm) {
  double p[2];
  to_pixels(frame, r, z, p);
  cw_picture_text(picture, align, p[0] + dx, p[1] + dy, "%s = %.1f mm", name, mm * 1e3);
}

CwStatus cw_picture_meridional(const CwDesign *design, const char *path) {
  CwStatus status = CW_OK;
  CwPicture picture = {0};
  CwMeridian m;
  CW_TRY(cw_meridian_make(design, &m));
  const double ri = design->interface_radius, half = design->outlet_width / 2;
  const double length = half - m.inlet_z, r1 = design->inlet_diameter / 2;
  const double scale = 560 / fmax(ri, length);
  const Frame frame = {scale, 70, scale * ri + 80, m.inlet_z};
  const double width = fmax(scale * length + 340, 700);
  CW_TRY(cw_picture_begin(&picture, path, width, scale * ri + 130));
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, 28,
                  "Meridional section: z = %d%s, nq = %.1f; passage %.0f mm2 in the eye, %.0f at the blade, %.0f at D2",
                  design->blade_count, design->splitter_start > 0 ? " with splitters" : "", design->specific_speed_nq,
                  design->passage_area_eye * 1e6, design->passage_area_inlet * 1e6, design->passage_area_outlet * 1e6);
  draw_blade(&picture, &frame, &m);
  if (design->splitter_start > 0) {
    double a[2], b[2];
    cw_meridian_blade_point(&m, 0, design->splitter_start, a, NULL);
    cw_meridian_blade_point(&m, 1, design->splitter_start, b, NULL);
    draw_segment(&picture, &frame, CW_STROKE_BLADE, a[0], a[1], b[0], b[1]);
  }
  draw_curve(&picture, &frame, &m.hub);
  draw_curve(&picture, &frame, &m.shroud);
  draw_nut(&picture, &frame, &m);
  draw_segment(&picture, &frame, CW_STROKE_WALL, r1, m.inlet_z, r1, m.shroud.pole[0][1]);
  draw_segment(&picture, &frame, CW_STROKE_THIN, m.shaft_radius, m.inlet_z, r1, m.inlet_z);
  draw_segment(&picture, &frame, CW_STROKE_THIN, ri, -half, ri, half);
  draw_segment(&picture, &frame, CW_STROKE_AXIS, 0, m.inlet_z - 0.05 * ri, 0, half + 0.1 * ri);
  label(&picture, &frame, CW_TEXT_LEFT, r1, m.inlet_z, 6, -8, "D1", design->inlet_diameter);
  label(&picture, &frame, CW_TEXT_LEFT, design->outlet_diameter / 2, half, 12, 4, "D2", design->outlet_diameter);
  label(&picture, &frame, CW_TEXT_MIDDLE, ri, 0, 0, -12, "b2", design->outlet_width);
  label(&picture, &frame, CW_TEXT_LEFT, design->hub_diameter / 2, m.hub.pole[0][1], 14, 14, "hub diameter",
        design->hub_diameter);
  if (m.shaft_radius > 0)
    label(&picture, &frame, CW_TEXT_LEFT, m.shaft_radius, m.inlet_z, 6, 14, "shaft", 2 * m.shaft_radius);
  if (design->root_fillet_radius > 0)
    label(&picture, &frame, CW_TEXT_LEFT, design->outlet_diameter / 2, half, 12, 24, "root fillets: R",
          design->root_fillet_radius);
  label(&picture, &frame, CW_TEXT_LEFT, design->leading_edge_radius_hub, half, 12, 4, "leading edge: hub r",
        design->leading_edge_radius_hub);
  double x[2], p[2], a[2], b[2];
  cw_meridian_blade_point(&m, 1, 0, x, NULL);
  to_pixels(&frame, x[0], x[1], p);
  cw_picture_text(&picture, CW_TEXT_RIGHT, p[0] - 8, p[1] - 4, "leading edge: shroud r = %.1f mm", x[0] * 1e3);
  to_pixels(&frame, 0.6 * r1, m.inlet_z, a);
  to_pixels(&frame, 0.6 * r1, m.inlet_z + 0.12 * ri, b);
  cw_picture_arrow(&picture, CW_STROKE_FLOW, a[0], a[1], b[0], b[1]);
  cw_picture_scale(&picture, width - 220, scale * ri + 110, scale * 1e-3);
  CW_TRY(cw_picture_end(&picture));
done:
  cw_picture_abandon(&picture);
  return status;
}
