// SPDX-License-Identifier: AGPL-3.0-or-later
// The volute in plan at z = 0, to scale, as the solid has it: spiral, tongue, throat, diffuser and pipe.
#include <math.h>

#include "geometry/picture.h"
#include "geometry/volute_diffuser.h"
#include "geometry/volute_section.h"
#include "geometry/volute_tongue.h"

enum { SPIRAL_POINTS = 181, NOSE_POINTS = 25, WALL_POINTS = 33, LINE_MOST = 512, STEP = 45 };
static const double largest = 640; // px

// From the tongue's frame to pixels: turned by minus the lean of the discharge, then scaled. Seen from the suction
// side, as the report's pictures are: y, along the discharge, points to the right (1), or to the left (-1) of a wheel
// that has its suction at z > 0.
typedef struct {
  double lean, scale, low[2], high[2], left, top;
  int right;
} Frame;

static void turned(const Frame *frame, const double x[2], double out[2]) {
  const double c = cos(frame->lean), s = sin(frame->lean);
  out[0] = frame->right * (-s * x[0] + c * x[1]);
  out[1] = c * x[0] + s * x[1];
}

static void reach(Frame *frame, const double x[2]) {
  double p[2];
  turned(frame, x, p);
  for (int k = 0; k < 2; k++) {
    frame->low[k] = fmin(frame->low[k], p[k]);
    frame->high[k] = fmax(frame->high[k], p[k]);
  }
}

static void to_pixels(const Frame *frame, const double x[2], double out[2]) {
  double p[2];
  turned(frame, x, p);
  out[0] = frame->left + frame->scale * (p[0] - frame->low[0]);
  out[1] = frame->top + frame->scale * (frame->high[1] - p[1]);
}

static void draw(CwPicture *picture, const Frame *frame, CwStroke stroke, double (*x)[2], int count) {
  double p[LINE_MOST][2];
  for (int i = 0; i < count; i++) to_pixels(frame, x[i], p[i]);
  cw_picture_line(picture, stroke, (const double(*)[2])p, count, 0);
}

static void segment(CwPicture *picture, const Frame *frame, CwStroke stroke, const double a[2], const double b[2]) {
  double x[2][2] = {{a[0], a[1]}, {b[0], b[1]}};
  draw(picture, frame, stroke, x, 2);
}

// A wall of the diffuser from the throat, where it runs along `along` (upward), to the outlet.
static int diffuser_wall(const CwVolute *volute, const double from[2], const double along[2], double side,
                         double x[WALL_POINTS + 1][2]) {
  const double lean = volute->discharge_lean, radius = volute->input.outlet_diameter / 2;
  const double end[3] = {volute->outlet_x + side * radius * cos(lean), volute->outlet_y + side * radius * sin(lean), 0};
  const double down[2] = {-sin(lean), cos(lean)};
  const CwDiffuserLines lines = cw_diffuser_lines(volute);
  const double start[3] = {from[0], from[1], 0}, leaving[3] = {lines.tangent * along[0] / along[1], lines.tangent, 0};
  for (int i = 0; i < WALL_POINTS; i++) {
    double point[3];
    cw_diffuser_line(&lines, start, leaving, end, (double)i / (WALL_POINTS - 1), point);
    for (int k = 0; k < 2; k++) x[i][k] = point[k];
  }
  for (int k = 0; k < 2; k++) x[WALL_POINTS][k] = end[k] + down[k] * volute->input.discharge_pipe_length;
  return WALL_POINTS + 1;
}

// All walls at z = 0, in order: spiral with the outer wall behind it, tongue with the inner wall.
typedef struct {
  double outer[SPIRAL_POINTS + WALL_POINTS + 1][2], inner[NOSE_POINTS + WALL_POINTS + 1][2];
  double throat[2][2];
  int outer_count, inner_count;
} Walls;

static void make_walls(const CwVolute *volute, Walls *walls) {
  const double last = cw_volute_throat_angle(volute, 0);
  double x[3], x_phi[3] = {0, 0, 0}, centre[2], normal[2];
  for (int i = 0; i < SPIRAL_POINTS; i++) {
    const double phi = volute->tip_angle + (last - volute->tip_angle) * i / (SPIRAL_POINTS - 1);
    cw_volute_wall_point(volute, phi, 0, x, x_phi, NULL);
    walls->outer[i][0] = walls->throat[1][0] = x[0];
    walls->outer[i][1] = walls->throat[1][1] = x[1];
  }
  walls->outer_count = SPIRAL_POINTS + diffuser_wall(volute, walls->throat[1], x_phi, 1, walls->outer + SPIRAL_POINTS);
  cw_volute_contact_circle(volute, volute->tip_angle, 0, centre, normal);
  // Round the nose, from where it touches the spiral to the flank at x = x_i.
  double from = atan2(-normal[1], -normal[0]);
  if (from > 0) from -= 2 * M_PI;
  for (int i = 0; i < NOSE_POINTS; i++) {
    const double angle = from * (NOSE_POINTS - 1 - i) / (NOSE_POINTS - 1);
    walls->inner[i][0] = centre[0] + volute->input.tongue_radius * cos(angle);
    walls->inner[i][1] = centre[1] + volute->input.tongue_radius * sin(angle);
  }
  walls->throat[0][0] = volute->inner_wall_x;
  walls->throat[0][1] = volute->throat_y;
  walls->inner_count =
      NOSE_POINTS + diffuser_wall(volute, walls->throat[0], (double[]){0, 1}, -1, walls->inner + NOSE_POINTS);
}

// Rays every 45 degrees from the base circle to the spiral, with the radius at their ends.
static void rays(CwPicture *picture, const Frame *frame, const CwVolute *volute) {
  const double r3 = volute->input.base_diameter / 2;
  for (int i = STEP; i <= 360; i += STEP) {
    const double phi = i * CW_DEGREE, r = cw_volute_section(volute, phi).outer_radius;
    const double a[2] = {r3 * cos(phi), r3 * sin(phi)}, b[2] = {r * cos(phi), r * sin(phi)};
    const double c[2] = {(r3 - 26 / frame->scale) * cos(phi), (r3 - 26 / frame->scale) * sin(phi)};
    double p[2];
    segment(picture, frame, CW_STROKE_THIN, a, b);
    to_pixels(frame, c, p);
    cw_picture_text(picture, CW_TEXT_MIDDLE, p[0], p[1] + 4, "%d\302\260", i);
  }
}

CwStatus cw_picture_volute_plan(const CwDesign *design, const char *path) {
  CwStatus status = CW_OK;
  CwPicture picture = {0};
  const CwVolute *volute = &design->volute;
  const CwVoluteInput *in = &volute->input;
  const int right = -cw_suction_side(design->rotation);
  Walls walls;
  Frame frame = {volute->discharge_lean, 1, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}, 60, 70, right};
  make_walls(volute, &walls);
  for (int i = 0; i < walls.outer_count; i++) reach(&frame, walls.outer[i]);
  for (int i = 0; i < walls.inner_count; i++) reach(&frame, walls.inner[i]);
  const double wide = frame.high[0] - frame.low[0], high = frame.high[1] - frame.low[1];
  frame.scale = largest / fmax(wide, high);
  const double bottom = frame.top + frame.scale * high;
  CW_TRY(cw_picture_begin(&picture, path, frame.left + fmax(frame.scale * wide + 60, 500), bottom + 150));
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, 28,
                  "Volute in plan at z = 0, from the suction side; angles from the start of the spiral, in the sense "
                  "of rotation");
  const double origin[2] = {0, 0}, pixels_per_mm = frame.scale * 1e-3;
  double p[2];
  to_pixels(&frame, origin, p);
  cw_picture_circle(&picture, CW_STROKE_THIN, p[0], p[1], frame.scale * in->base_diameter / 2);
  cw_picture_circle(&picture, CW_STROKE_AXIS, p[0], p[1], frame.scale * in->interface_radius);
  cw_picture_segment(&picture, CW_STROKE_AXIS, p[0] - 16, p[1], p[0] + 16, p[1]);
  cw_picture_segment(&picture, CW_STROKE_AXIS, p[0], p[1] - 16, p[0], p[1] + 16);
  rays(&picture, &frame, volute);
  draw(&picture, &frame, CW_STROKE_WALL, walls.outer, walls.outer_count);
  draw(&picture, &frame, CW_STROKE_WALL, walls.inner, walls.inner_count);
  segment(&picture, &frame, CW_STROKE_FLOW, walls.throat[0], walls.throat[1]);
  const double lean = volute->discharge_lean;
  for (int end = 0; end < 2; end++) {
    const double at[2] = {volute->outlet_x - end * in->discharge_pipe_length * sin(lean),
                          volute->outlet_y + end * in->discharge_pipe_length * cos(lean)};
    const double half[2] = {in->outlet_diameter / 2 * cos(lean), in->outlet_diameter / 2 * sin(lean)};
    const double a[2] = {at[0] - half[0], at[1] - half[1]}, b[2] = {at[0] + half[0], at[1] + half[1]};
    segment(&picture, &frame, CW_STROKE_THIN, a, b);
  }
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, bottom + 38, "D3 = %.1f mm; throat %.0f mm2 (orange), %.1f mm wide",
                  in->base_diameter * 1e3, volute->throat_area * 1e6, volute->throat_width * 1e3);
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, bottom + 60,
                  "tongue: nose radius %.2f mm, tip at r = %.1f mm and %.1f deg", in->tongue_radius * 1e3,
                  volute->tip_radius * 1e3, volute->tip_angle / CW_DEGREE);
  cw_picture_text(&picture, CW_TEXT_LEFT, 20, bottom + 82,
                  "diffuser %.1f mm, %.1f deg, area ratio %.2f; discharge DN = %.1f mm, pipe %.0f mm",
                  volute->diffuser_length * 1e3, volute->diffuser_angle / CW_DEGREE, volute->diffuser_area_ratio,
                  in->outlet_diameter * 1e3, in->discharge_pipe_length * 1e3);
  cw_picture_scale(&picture, 20, bottom + 124, pixels_per_mm);
  CW_TRY(cw_picture_end(&picture));
done:
  cw_picture_abandon(&picture);
  return status;
}
