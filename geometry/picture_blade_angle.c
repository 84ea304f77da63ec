// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/blade.h"
#include "geometry/meridian.h"
#include "geometry/picture.h"

enum { POINTS = 60 };
static const double width = 560, height = 220, left = 80;

// A range that ends on a round number, in four or five steps.
static double round_step(double largest) {
  const double power = pow(10, floor(log10(largest / 4)));
  static const double steps[] = {1, 1.5, 2, 2.5, 3, 5, 10};
  for (int i = 0; i < 7; i++)
    if (steps[i] * power * 5 >= largest) return steps[i] * power;
  return 10 * power;
}

// Axes from p = 0 to 1 and 0 to 5 steps, with lines across.
static void axes(CwPicture *picture, double bottom, double step, const char *title) {
  cw_picture_text(picture, CW_TEXT_LEFT, left, bottom - height - 14, "%s", title);
  for (int i = 0; i <= 5; i++) {
    const double y = bottom - height * i / 5;
    cw_picture_segment(picture, CW_STROKE_THIN, left, y, left + width, y);
    cw_picture_text(picture, CW_TEXT_RIGHT, left - 8, y + 4, "%g", step * i);
    cw_picture_text(picture, CW_TEXT_MIDDLE, left + width * i / 5, bottom + 18, "%.1f", i / 5.0);
  }
}

// A curve, with its name, if any, at the right end.
static void curve(CwPicture *picture, CwStroke stroke, const double *y, double bottom, double top, const char *name,
                  double name_shift) {
  double line[POINTS + 1][2];
  for (int i = 0; i <= POINTS; i++) {
    line[i][0] = left + width * i / POINTS;
    line[i][1] = bottom - height * y[i] / top;
  }
  cw_picture_line(picture, stroke, (const double(*)[2])line, POINTS + 1, 0);
  if (name) cw_picture_text(picture, CW_TEXT_LEFT, left + width + 8, line[POINTS][1] + 4 + name_shift, "%s", name);
}

CwStatus cw_picture_blade_angle(const CwDesign *design, const char *path) {
  CwStatus status = CW_OK;
  CwPicture picture = {0};
  CwMeridian m;
  static const char *const where[] = {"hub", "mid-span", "shroud"};
  static const CwStroke stroke[] = {CW_STROKE_WALL, CW_STROKE_FLOW, CW_STROKE_BLADE};
  const double first = 290, second = 600;
  double beta[3][POINTS + 1], open[POINTS + 1], blocked[POINTS + 1], most_beta = 0, most_area = 0;
  CW_TRY(cw_meridian_make(design, &m));
  for (int j = 0; j < 3; j++) {
    CwBladeSection section;
    CW_TRY(cw_blade_section(design, &m, 0.5 * j, &section));
    for (int i = 0; i <= POINTS; i++) {
      const double p = (double)i / POINTS;
      beta[j][i] = cw_blade_beta(&section, p) * 180 / M_PI;
      most_beta = fmax(most_beta, beta[j][i]);
      if (j != 1) continue;
      double x[2];
      cw_meridian_blade_point(&m, 0.5, p, x, NULL);
      const int blades = design->blade_count * (design->splitter_start > 0 && p >= design->splitter_start ? 2 : 1);
      const double thickness = p < section.nose ? 0 : 2 * cw_blade_half_thickness(&section, p);
      open[i] = cw_meridian_area(&m, p) * 1e6;
      blocked[i] = open[i] * (1 - blades * thickness / (2 * M_PI * x[0] * sin(cw_blade_beta(&section, p))));
      most_area = fmax(most_area, open[i]);
    }
  }
  CW_TRY(cw_picture_begin(&picture, path, left + width + 120, second + 60));
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, 28, "Along the blade, from the leading (0) to the trailing edge (1)");
  const double beta_step = round_step(1.1 * most_beta), area_step = round_step(1.05 * most_area);
  axes(&picture, first, beta_step, "Blade angle beta from the tangential direction, deg");
  for (int j = 0; j < 3; j++) {
    curve(&picture, stroke[j], beta[j], first, 5 * beta_step, NULL, 0);
    const double x = left + 140 * j + 20, y = first - 16;
    cw_picture_segment(&picture, stroke[j], x, y, x + 30, y);
    cw_picture_text(&picture, CW_TEXT_LEFT, x + 38, y + 4, "%s", where[j]);
  }
  axes(&picture, second, area_step, "Passage area normal to the meridional flow, mm2");
  curve(&picture, CW_STROKE_BLADE, open, second, 5 * area_step, "without blades", -4);
  curve(&picture, CW_STROKE_FLOW, blocked, second, 5 * area_step, "with blades", 6);
  cw_picture_text(&picture, CW_TEXT_MIDDLE, left + width / 2, second + 40, "share of the meridional length");
  CW_TRY(cw_picture_end(&picture));
done:
  cw_picture_abandon(&picture);
  return status;
}
