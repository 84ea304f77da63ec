// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/blade.h"
#include "geometry/meridian.h"
#include "geometry/picture.h"

enum { SIDE = 120, NOSE = 24, OUTLINE = 2 * SIDE + 2 * NOSE + 4 };

// The outline at mid-span from the trailing edge along the suction side round the nose and back along the
// pressure side; (r, theta).
static void outline(const CwDesign *design, const CwBladeSection *section, double (*x)[2]) {
  const CwTrailingEdge edge = design->trailing_edge;
  const int faceted = edge == CW_EDGE_BEVELLED || edge == CW_EDGE_SHARP;
  const double begin = faceted ? cw_blade_bevel_begin(section, edge, design->trailing_edge_bevel) : section->end;
  for (int i = 0; i < OUTLINE; i++) {
    CwBladePoint point;
    if (i <= SIDE)
      point = cw_blade_side(section, CW_BLADE_SUCTION, begin + (section->nose - begin) * i / SIDE);
    else if (i <= SIDE + NOSE)
      point = cw_blade_leading_edge(section, M_PI * ((double)(i - SIDE) / NOSE - 0.5));
    else if (i <= 2 * SIDE + NOSE + 1)
      point = cw_blade_side(section, CW_BLADE_PRESSURE,
                            section->nose + (section->end - section->nose) * (i - SIDE - NOSE - 1) / SIDE);
    else if (edge == CW_EDGE_ROUNDED)
      point = cw_blade_trailing_edge(section, M_PI * (0.5 - (double)(i - 2 * SIDE - NOSE - 2) / (NOSE + 1)));
    else if (edge == CW_EDGE_BEVELLED)
      point = (CwBladePoint){1, cw_blade_bevel_theta(section, begin)};
    else
      point = cw_blade_side(section, edge == CW_EDGE_BLUNT ? CW_BLADE_SUCTION : CW_BLADE_PRESSURE, 1);
    double rz[2];
    cw_meridian_blade_point(section->meridian, section->span, point.q, rz, NULL);
    x[i][0] = rz[0];
    x[i][1] = point.theta;
  }
}

// From polar coordinates to the sheet, seen from the suction side with x up, as the report's pictures are: y points to
// the right, or to the left of a wheel that has its suction at z > 0.
typedef struct {
  double scale, x, y; // px/m; of the axis, px
  int right;          // 1 or -1
} Sheet;

static void place(const Sheet *sheet, double r, double theta, double x[2]) {
  x[0] = sheet->x + sheet->right * sheet->scale * r * sin(theta);
  x[1] = sheet->y - sheet->scale * r * cos(theta);
}

// An arc about the axis.
enum { ARC = 41 };
static void arc(const Sheet *sheet, double r, double begin, double end, double x[ARC][2]) {
  for (int i = 0; i < ARC; i++) place(sheet, r, begin + (end - begin) * i / (ARC - 1), x[i]);
}

// From the axis outwards.
static void ray(CwPicture *picture, const Sheet *sheet, double r, double theta) {
  double x[2];
  place(sheet, r, theta, x);
  cw_picture_segment(picture, CW_STROKE_THIN, sheet->x, sheet->y, x[0], x[1]);
}

CwStatus cw_picture_blade_plan(const CwDesign *design, const char *path) {
  CwStatus status = CW_OK;
  CwPicture picture = {0};
  CwMeridian m;
  CwBladeSection section, splitter;
  double polar[OUTLINE][2], x[OUTLINE][2], line[ARC][2];
  const double scale = 320 / design->interface_radius, centre = 360, tip = design->outlet_diameter / 2;
  const int right = -cw_suction_side(design->rotation);
  const Sheet sheet = {scale, centre, centre + 20, right};
  CW_TRY(cw_meridian_make(design, &m));
  CW_TRY(cw_blade_section(design, &m, 0.5, &section));
  CW_TRY(cw_picture_begin(&picture, path, 2 * centre, 2 * centre + 40));
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, 28,
                  "Blades at mid-span in plan, from the suction side, x up; wrap %.1f, beta1 %.1f, beta2 %.1f deg",
                  design->wrap_angle * 180 / M_PI, design->inlet_blade_angle * 180 / M_PI,
                  design->outlet_blade_angle * 180 / M_PI);
  cw_picture_circle(&picture, CW_STROKE_THIN, sheet.x, sheet.y, scale * design->interface_radius);
  cw_picture_circle(&picture, CW_STROKE_THIN, sheet.x, sheet.y, scale * design->inlet_diameter / 2);
  for (int kind = 0; kind < (design->splitter_start > 0 ? 2 : 1); kind++) {
    splitter = kind ? cw_blade_splitter(design, &section) : section;
    outline(design, &splitter, polar);
    for (int k = 0; k < design->blade_count; k++) {
      for (int i = 0; i < OUTLINE; i++)
        place(&sheet, polar[i][0], polar[i][1] + 2 * M_PI * k / design->blade_count, x[i]);
      cw_picture_line(&picture, CW_STROKE_BLADE, (const double(*)[2])x, OUTLINE, 1);
    }
  }
  // The wrap of blade 1, between the rays to the ends of its mean line, and the sense of rotation.
  arc(&sheet, 0.16 * tip, 0, section.theta[0], line);
  cw_picture_line(&picture, CW_STROKE_THIN, (const double(*)[2])line, ARC, 0);
  ray(&picture, &sheet, tip, 0);
  ray(&picture, &sheet, m.hub.pole[3][0] * 0.5, section.theta[0]);
  arc(&sheet, 0.25 * tip, -M_PI / 2 * right - M_PI / 4, -M_PI / 2 * right + M_PI / 4, line); // on the left
  cw_picture_line(&picture, CW_STROKE_FLOW, (const double(*)[2])line, ARC - 1, 0);
  cw_picture_arrow(&picture, CW_STROKE_FLOW, line[38][0], line[38][1], line[40][0] + 4, line[40][1] - 4 * right);
  cw_picture_text(&picture, CW_TEXT_RIGHT, line[20][0] - 4, line[20][1] + 4, "n");
  cw_picture_text(&picture, CW_TEXT_RIGHT, centre + 340, centre + 56 + scale * design->interface_radius,
                  "D2 = %.1f mm; circles: D1 = %.1f mm, interface r = %.1f mm", design->outlet_diameter * 1e3,
                  design->inlet_diameter * 1e3, design->interface_radius * 1e3);
  cw_picture_scale(&picture, 20, centre + 56 + scale * design->interface_radius, scale * 1e-3);
  CW_TRY(cw_picture_end(&picture));
done:
  cw_picture_abandon(&picture);
  return status;
}
