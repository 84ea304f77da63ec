// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/faces_picture.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/picture.h"
#include "pipeline/report/camera.h"
#include "pipeline/report/html.h"
#include "pipeline/report/render.h"

enum { SIDE = 560, HEAD = 34, FOOT = 60, COLUMNS = 4, VIEWS = 8, MARGIN = 18, ROOM = 18 * 12, LINE_MOST = 180 };

static const double towards[VIEWS / 2][3] = {{1, 0.5, 0.7}, {-1, -0.5, 0.7}, {-0.5, 1, -0.7}, {0.5, -1, -0.7}};

// Where a face is seen in one view.
typedef struct {
  int samples;
  double x, y;       // mean of them, px
  double at[2], off; // the sample nearest to it
} Seen;

typedef struct {
  const CwSurvey *survey;
  int part;
  CwPicture picture;
  Seen *seen; // VIEWS of each face
} Work;

static const double *corner_of(const CwSurvey *survey, int triangle, int k) {
  return survey->point[survey->triangle[triangle][k]];
}

static void set_camera(const Work *work, int view, CwCamera *camera) {
  static const double up[3] = {0, 0, 1};
  CwCameraReach reach = {0};
  *camera = (CwCamera){.width = SIDE, .height = SIDE};
  cw_camera_turn(camera, towards[view % COLUMNS], up);
  for (int f = 0; f < work->survey->face_count; f++) {
    const CwSurveyFace *face = &work->survey->face[f];
    for (int t = 0; face->part == work->part && t < 3 * face->triangle_count; t++)
      cw_camera_reach(camera, corner_of(work->survey, face->first_triangle + t / 3, t % 3), &reach);
  }
  for (int s = 0; s < work->survey->segment_count; s++) {
    const CwSurveySegment *segment = &work->survey->segment[s];
    for (int k = 0; work->survey->face[segment->face].part == work->part && k < 2; k++)
      cw_camera_reach(camera, segment->at[k], &reach);
  }
  cw_camera_fit(camera, &reach, MARGIN);
}

// A light colour for each number; neighbours differ much (the golden section of the circle of hues).
static uint32_t colour_of(int face) {
  const double hue = 2 * M_PI * fmod(0.618034 * face, 1);
  uint32_t colour = 0;
  for (int k = 0; k < 3; k++) colour = colour << 8 | (uint32_t)lround(205 + 45 * cos(hue - k * 2 * M_PI / 3));
  return colour;
}

static void draw_face(const Work *work, int f, const CwCamera *camera, int inside, CwCanvas *canvas) {
  const CwSurveyFace *face = &work->survey->face[f];
  for (int t = face->first_triangle; t < face->first_triangle + face->triangle_count; t++) {
    double p[3][3];
    for (int k = 0; k < 3; k++) cw_camera_project(camera, corner_of(work->survey, t, k), p[k]);
    // y runs down, so that what faces the viewer is clockwise.
    const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
    if (inside ? area <= 0 : area >= 0) continue;
    double normal[3];
    for (int i = 0; i < 3; i++) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      normal[i] = ((p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j])) /
                  (i == 2 ? 1 : camera->metres_per_pixel); // depth is in metres
    }
    const double slope = 1 - fabs(normal[2]) / hypot(hypot(normal[0], normal[1]), normal[2]);
    const CwPaint paint = {.colour = cw_render_shade(colour_of(f), 1.05 - 0.35 * slope), .group = (uint16_t)(f + 1)};
    cw_render_triangle(canvas, (const double(*)[3])p, &paint);
  }
}

// Twice over the samples: the mean of each face's, then the sample nearest to it.
static void look(Work *work, int view, const CwCanvas *canvas) {
  for (int pass = 0; pass < 2; pass++) {
    for (int i = 0; i < canvas->columns * canvas->rows; i++) {
      if (!canvas->group[i]) continue;
      Seen *seen = &work->seen[VIEWS * (canvas->group[i] - 1) + view];
      const double x = (i % canvas->columns + 0.5) / CW_RENDER_SAMPLES,
                   y = (i / canvas->columns + 0.5) / CW_RENDER_SAMPLES;
      if (pass == 0) {
        seen->samples++;
        seen->x += x;
        seen->y += y;
        seen->off = INFINITY;
        continue;
      }
      const double off = hypot(x - seen->x / seen->samples, y - seen->y / seen->samples);
      if (off >= seen->off) continue;
      *seen = (Seen){seen->samples, seen->x, seen->y, {x, y}, off};
    }
  }
}

static void mark(Work *work, const CwCamera *camera, const double *place, double x, double y) {
  double p[3];
  cw_camera_project(camera, place, p);
  cw_picture_circle(&work->picture, CW_STROKE_FLOW, x + p[0], y + p[1], 12);
  cw_picture_segment(&work->picture, CW_STROKE_FLOW, x + p[0] - 20, y + p[1], x + p[0] + 20, y + p[1]);
  cw_picture_segment(&work->picture, CW_STROKE_FLOW, x + p[0], y + p[1] - 20, x + p[0], y + p[1] + 20);
}

// The edges of faces that have no triangles.
static void draw_outlines(Work *work, const CwCamera *camera, double x, double y) {
  for (int s = 0; s < work->survey->segment_count; s++) {
    const CwSurveySegment *segment = &work->survey->segment[s];
    double a[3], b[3];
    if (work->survey->face[segment->face].part != work->part) continue;
    cw_camera_project(camera, segment->at[0], a);
    cw_camera_project(camera, segment->at[1], b);
    cw_picture_segment(&work->picture, CW_STROKE_BLADE, x + a[0], y + a[1], x + b[0], y + b[1]);
  }
}

static CwStatus draw_view(Work *work, int view, const double *place) {
  CwStatus status = CW_OK;
  CwCanvas canvas = {0};
  CwCamera camera;
  CwPng png = {0};
  const int inside = view >= COLUMNS;
  const double x = view % COLUMNS * SIDE, y = HEAD + view / COLUMNS * SIDE;
  const CwAnnotation none = {0};
  CW_TRY(cw_render_start(SIDE, SIDE, 0xffffff, 1, &canvas));
  set_camera(work, view, &camera);
  for (int f = 0; f < work->survey->face_count; f++)
    if (work->survey->face[f].part == work->part) draw_face(work, f, &camera, inside, &canvas);
  look(work, view, &canvas);
  cw_render_outline(&canvas, 0x52606d, 0.02 * work->survey->size);
  CW_TRY(cw_render_png(&canvas, &none, &png));
  FILE *stream = work->picture.file.stream;
  fprintf(stream, "<image x=\"%.0f\" y=\"%.0f\" width=\"%d\" height=\"%d\" href=\"data:image/png;base64,", x, y, SIDE,
          SIDE);
  cw_html_base64(stream, png.bytes, png.size);
  fputs("\"/>\n", stream);
  cw_picture_text(&work->picture, CW_TEXT_LEFT, x + 8, y + 16, "%s, from (%g, %g, %g)",
                  inside ? "near faces taken away" : "from outside", towards[view % COLUMNS][0],
                  towards[view % COLUMNS][1], towards[view % COLUMNS][2]);
  draw_outlines(work, &camera, x, y);
  if (place) mark(work, &camera, place, x, y);
done:
  cw_render_free(&canvas);
  cw_png_free(&png);
  return status;
}

// The view that shows most of a face, or -1.
static int best_view(const Seen *seen) {
  int best = -1;
  for (int v = 0; v < VIEWS; v++)
    if (seen[v].samples > (best < 0 ? 0 : seen[best].samples)) best = v;
  return best;
}

static void write_numbers(Work *work) {
  char hidden[LINE_MOST] = "";
  size_t used = 0;
  for (int f = 0; f < work->survey->face_count; f++) {
    if (work->survey->face[f].part != work->part) continue;
    const Seen *seen = &work->seen[VIEWS * f];
    const int best = best_view(seen);
    for (int v = 0; v < VIEWS; v++) {
      if (v != best && seen[v].samples < ROOM * CW_RENDER_SAMPLES * CW_RENDER_SAMPLES) continue;
      cw_picture_text(&work->picture, CW_TEXT_MIDDLE, v % COLUMNS * SIDE + seen[v].at[0],
                      HEAD + v / COLUMNS * SIDE + seen[v].at[1] + 4, "%d", f + 1);
    }
    if (best < 0 && used < sizeof hidden - 12)
      used += (size_t)snprintf(hidden + used, sizeof hidden - used, " %d", f + 1);
  }
  if (used) cw_picture_text(&work->picture, CW_TEXT_LEFT, 8, HEAD + 2 * SIDE + 24, "seen from nowhere:%s", hidden);
}

CwStatus cw_faces_picture_write(const CwSurvey *survey, int part, const char *title, const double *place,
                                const char *path) {
  CwStatus status = CW_OK;
  Work work = {survey, part, {{0}}, NULL};
  CW_NEW(work.seen, VIEWS * (size_t)survey->face_count);
  CW_TRY(cw_picture_begin(&work.picture, path, COLUMNS * SIDE, HEAD + 2 * SIDE + FOOT));
  for (int v = 0; v < VIEWS; v++) CW_TRY(draw_view(&work, v, place));
  write_numbers(&work);
  cw_picture_text(&work.picture, CW_TEXT_LEFT, 8, 22, "%s", title);
  CW_TRY(cw_picture_end(&work.picture));
done:
  cw_picture_abandon(&work.picture);
  free(work.seen);
  return status;
}
