// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/blade.h"
#include "geometry/meridian.h"
#include "geometry/picture.h"

enum { POINTS = 60 };
static const double width = 560, height = 220, left = 70;

// Axes from q = 0 to 1 and 0 to `top`, with five lines across.
static void axes(CwPicture *picture, double bottom, double top, const char *title, const char *format) {
  cw_picture_text(picture, CW_TEXT_LEFT, left, bottom - height - 12, "%s", title);
  for (int i = 0; i <= 5; i++) {
    const double y = bottom - height * i / 5;
    char number[32];
    cw_picture_segment(picture, CW_STROKE_THIN, left, y, left + width, y);
    snprintf(number, sizeof number, format, top * i / 5);
    cw_picture_text(picture, CW_TEXT_RIGHT, left - 8, y + 4, "%s", number);
    snprintf(number, sizeof number, "%.1f", i / 5.0);
    cw_picture_text(picture, CW_TEXT_MIDDLE, left + width * i / 5, bottom + 18, "%s", number);
  }
}

CwStatus cw_picture_blade_angle(const CwDesign *design, const char *path) {
  CwStatus status = CW_OK;
  CwPicture picture = {0};
  CwMeridian m;
  static const char *const where[] = {"hub", "mid-span", "shroud"};
  static const CwStroke stroke[] = {CW_STROKE_WALL, CW_STROKE_FLOW, CW_STROKE_BLADE};
  const double first = 290, second = 590;
  double line[POINTS + 1][2], largest = 0;
  CW_TRY(cw_meridian_make(design, &m));
  CW_TRY(cw_picture_begin(&picture, path, left + width + 110, second + 50));
  axes(&picture, first, 60, "Blade angle beta, deg, over the length from leading to trailing edge", "%.0f");
  for (int j = 0; j < 3; j++) {
    CwBladeSection section;
    CW_TRY(cw_blade_section(design, &m, 0.5 * j, &section));
    for (int i = 0; i <= POINTS; i++) {
      line[i][0] = left + width * i / POINTS;
      line[i][1] = first - height * cw_blade_beta(&section, (double)i / POINTS) * 3 / M_PI;
    }
    cw_picture_line(&picture, stroke[j], (const double(*)[2])line, POINTS + 1, 0);
    const double x = left + 140 * j + 20, y = first - 16;
    cw_picture_segment(&picture, stroke[j], x, y, x + 30, y);
    cw_picture_text(&picture, CW_TEXT_LEFT, x + 38, y + 4, "%s", where[j]);
  }
  for (int i = 0; i <= POINTS; i++)
    largest = fmax(largest, cw_meridian_area(&m, (double)i / POINTS));
  const double top = 1000 * ceil(largest * 1e6 / 1000);
  axes(&picture, second, top, "Passage area without blades, mm2", "%.0f");
  for (int i = 0; i <= POINTS; i++) {
    line[i][0] = left + width * i / POINTS;
    line[i][1] = second - height * cw_meridian_area(&m, (double)i / POINTS) * 1e6 / top;
  }
  cw_picture_line(&picture, CW_STROKE_BLADE, (const double(*)[2])line, POINTS + 1, 0);
  CW_TRY(cw_picture_end(&picture));
done:
  cw_picture_abandon(&picture);
  return status;
}
