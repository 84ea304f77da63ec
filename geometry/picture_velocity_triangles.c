// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/picture.h"

// One triangle: u from left to right, c from its left end, w from its right end to the same apex.
static void triangle(CwPicture *picture, double left, double base, double scale, const char *where, double u,
                     double cu, double cm) {
  const double x1 = left + scale * u, xa = left + scale * cu, ya = base - scale * cm;
  cw_picture_text(picture, CW_TEXT_LEFT, left, ya - 36, "%s", where);
  cw_picture_arrow(picture, CW_STROKE_WALL, left, base, x1, base);
  cw_picture_arrow(picture, CW_STROKE_FLOW, left, base, xa, ya);
  cw_picture_arrow(picture, CW_STROKE_BLADE, x1, base, xa, ya);
  cw_picture_segment(picture, CW_STROKE_THIN, xa, ya, xa, base);
  cw_picture_text(picture, CW_TEXT_MIDDLE, 0.5 * (left + x1), base + 20, "u = %.2f m/s", u);
  cw_picture_text(picture, CW_TEXT_RIGHT, 0.5 * (left + xa) - 6, 0.5 * (base + ya) - 8, "c = %.2f",
                  hypot(cu, cm));
  cw_picture_text(picture, CW_TEXT_LEFT, 0.5 * (x1 + xa) + 8, 0.5 * (base + ya) - 8, "w = %.2f",
                  hypot(u - cu, cm));
  cw_picture_text(picture, CW_TEXT_LEFT, x1 + 14, base + 4, "c_u = %.2f, c_m = %.2f, beta = %.1f deg", cu, cm,
                  atan2(cm, u - cu) * 180 / M_PI);
}

CwStatus cw_picture_velocity_triangles(const CwDesign *design, const char *path) {
  CwStatus status = CW_OK;
  CwPicture picture = {0};
  const double scale = 480 / design->impeller_tip_speed;
  const double cm1 = design->inlet_meridional_speed * design->inlet_blockage,
               cm2 = design->outlet_meridional_speed;
  const double first = 120 + scale * cm1, second = first + 120 + scale * cm2;
  CW_TRY(cw_picture_begin(&picture, path, 900, second + 90));
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, 28, "Velocity triangles, m/s");
  triangle(&picture, 70, first, scale, "inlet, mid-span, with blockage, no pre-swirl",
           design->inlet_blade_speed, 0, cm1);
  triangle(&picture, 70, second, scale, "outlet, behind the blades, with slip", design->impeller_tip_speed,
           design->outlet_swirl_speed, cm2);
  cw_picture_text(&picture, CW_TEXT_LEFT, 70, second + 60,
                  "blade angles %.1f and %.1f deg, slip factor %.3f, predicted head %.2f m (asked %.2f m)",
                  design->inlet_blade_angle * 180 / M_PI, design->outlet_blade_angle * 180 / M_PI,
                  design->slip_factor, design->predicted_head, design->head);
  CW_TRY(cw_picture_end(&picture));
done:
  cw_picture_abandon(&picture);
  return status;
}
