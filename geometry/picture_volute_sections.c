// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/picture.h"
#include "geometry/volute_section.h"

enum { STEP = 45, COUNT = 360 / STEP, POINTS = 96, SIDE_POINTS = 48 };
static const double left = 80, width = 620, chart = 250;

// A length or area to end an axis at: 1, 2 or 5 times a power of ten, five steps of which reach `largest`.
static double round_top(double largest) {
  const double step = largest / 5, power = pow(10, floor(log10(step)));
  const double times = step / power <= 1 ? 1 : step / power <= 2 ? 2 : step / power <= 5 ? 5 : 10;
  return 5 * times * power;
}

// Area over the angle behind the start of the spiral: dashed up to the tongue, where the spiral has no wall.
static void area_chart(CwPicture *picture, const CwVolute *volute, double bottom) {
  double top = round_top(cw_volute_section(volute, 2 * M_PI).area * 1e6), line[POINTS + 1][2];
  cw_picture_text(picture, CW_TEXT_LEFT, left, bottom - chart - 14,
                  "Area outside D3/2, mm2, over the angle behind the start of the spiral, deg");
  for (int i = 0; i <= 5; i++) {
    const double y = bottom - chart * i / 5;
    cw_picture_segment(picture, CW_STROKE_THIN, left, y, left + width, y);
    cw_picture_text(picture, CW_TEXT_RIGHT, left - 8, y + 4, "%.4g", top * i / 5);
  }
  for (int i = 0; i <= COUNT; i++) {
    const double x = left + width * i / COUNT, area = cw_volute_section(volute, i * STEP * CW_DEGREE).area * 1e6;
    cw_picture_segment(picture, CW_STROKE_THIN, x, bottom, x, bottom - chart * area / top);
    cw_picture_text(picture, CW_TEXT_MIDDLE, x, bottom + 18, "%d", i * STEP);
    cw_picture_circle(picture, CW_STROKE_BLADE, x, bottom - chart * area / top, 3);
  }
  const double tip = volute->tip_angle;
  for (int part = 0; part < 2; part++) {
    const double from = part ? tip : 0, to = part ? 2 * M_PI : tip;
    for (int i = 0; i <= POINTS; i++) {
      const double phi = from + (to - from) * i / POINTS;
      line[i][0] = left + width * phi / (2 * M_PI);
      line[i][1] = bottom - chart * cw_volute_section(volute, phi).area * 1e6 / top;
    }
    cw_picture_line(picture, part ? CW_STROKE_BLADE : CW_STROKE_AXIS, (const double(*)[2])line, POINTS + 1, 0);
  }
  const double x = left + width * tip / (2 * M_PI);
  cw_picture_segment(picture, CW_STROKE_FLOW, x, bottom, x, bottom - 0.55 * chart);
  cw_picture_text(picture, CW_TEXT_LEFT, x + 6, bottom - 0.55 * chart + 10, "tongue, %.1f deg", tip / CW_DEGREE);
}

// Half outline from the base circle along the side wall and over the outer wall to z = 0; (r, z) in m.
static int outline(const CwVolute *volute, double phi, double x[SIDE_POINTS + 2][2]) {
  x[0][0] = volute->input.base_diameter / 2;
  x[0][1] = volute->input.inlet_width / 2;
  for (int i = 0; i <= SIDE_POINTS; i++) {
    double p[3];
    cw_volute_wall_point(volute, phi, volute->arc_half_angle * (SIDE_POINTS - i) / SIDE_POINTS, p, NULL, NULL);
    x[i + 1][0] = hypot(p[0], p[1]);
    x[i + 1][1] = p[2];
  }
  return SIDE_POINTS + 2;
}

// The sections every 45 degrees over one another, radius upward, each with its number of degrees.
static void outlines(CwPicture *picture, const CwVolute *volute, double bottom, double scale) {
  const double r3 = volute->input.base_diameter / 2, middle = left + 0.42 * width;
  double half[SIDE_POINTS + 2][2], whole[2 * (SIDE_POINTS + 2)][2];
  for (int i = COUNT; i >= 1; i--) {
    const int count = outline(volute, i * STEP * CW_DEGREE, half);
    for (int k = 0; k < count; k++) {
      whole[k][0] = middle - scale * half[k][1];
      whole[2 * count - 1 - k][0] = middle + scale * half[k][1];
      whole[k][1] = whole[2 * count - 1 - k][1] = bottom - scale * (half[k][0] - r3);
    }
    cw_picture_line(picture, i % 2 ? CW_STROKE_BLADE : CW_STROKE_WALL, (const double(*)[2])whole, 2 * count,
                    i == COUNT);
    const CwVoluteSection s = cw_volute_section(volute, i * STEP * CW_DEGREE);
    const double y = bottom - scale * (s.outer_radius - r3);
    cw_picture_segment(picture, CW_STROKE_THIN, middle, y, left + 0.80 * width, y);
    cw_picture_text(picture, CW_TEXT_LEFT, left + 0.81 * width, y + 4, "%d deg: %.0f mm2, r = %.1f mm", i * STEP,
                    s.area * 1e6, s.outer_radius * 1e3);
  }
  const double b3 = scale * volute->input.inlet_width;
  cw_picture_segment(picture, CW_STROKE_AXIS, middle, bottom + 12, middle,
                     bottom - scale * (cw_volute_section(volute, 2 * M_PI).outer_radius - r3) - 12);
  cw_picture_segment(picture, CW_STROKE_FLOW, middle - b3 / 2, bottom, middle + b3 / 2, bottom);
  cw_picture_text(picture, CW_TEXT_MIDDLE, middle, bottom + 26, "D3/2 = %.1f mm, b3 = %.1f mm", r3 * 1e3,
                  volute->input.inlet_width * 1e3);
}

CwStatus cw_picture_volute_sections(const CwDesign *design, const char *path) {
  static const char *const section[] = {"trapezoid", "rectangle", "circle"};
  static const char *const discharge[] = {"tangential", "radial"};
  CwStatus status = CW_OK;
  CwPicture picture = {0};
  const CwVolute *volute = &design->volute;
  const CwVoluteInput *in = &volute->input;
  const CwVoluteSection last = cw_volute_section(volute, 2 * M_PI);
  const double height = last.outer_radius - in->base_diameter / 2;
  const double half_width = fmax(last.kink_height, last.flat + last.arc_radius);
  const double scale = fmin(420 / height, 0.36 * width / half_width);
  const double first = chart + 90, second = first + 110 + scale * height;
  CW_TRY(cw_picture_begin(&picture, path, left + width + 160, second + 60));
  if (in->area_law == CW_AREA_LAW_VELOCITY)
    cw_picture_text(&picture, CW_TEXT_LEFT, 20, 28,
                    "Volute: %s sections, constant velocity %.2f m/s, throat %.0f mm2, %s discharge",
                    section[in->section], volute->law_constant, volute->throat_area * 1e6, discharge[in->discharge]);
  else
    cw_picture_text(&picture, CW_TEXT_LEFT, 20, 28,
                    "Volute: %s sections, constant angular momentum %.3f m2/s, throat %.0f mm2, %s discharge",
                    section[in->section], volute->law_constant, volute->throat_area * 1e6, discharge[in->discharge]);
  area_chart(&picture, volute, first);
  outlines(&picture, volute, second, scale);
  CW_TRY(cw_picture_end(&picture));
done:
  cw_picture_abandon(&picture);
  return status;
}
