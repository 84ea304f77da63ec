// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/picture.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

static const struct {
  const char *colour, *style;
} strokes[] = {
    [CW_STROKE_WALL] = {"#1f2933", "stroke-width=\"2\""},
    [CW_STROKE_BLADE] = {"#0b5c8a", "stroke-width=\"1.6\""},
    [CW_STROKE_THIN] = {"#7b8794", "stroke-width=\"0.8\""},
    [CW_STROKE_AXIS] = {"#7b8794", "stroke-width=\"0.8\" stroke-dasharray=\"12 3 2 3\""},
    [CW_STROKE_FLOW] = {"#b8450c", "stroke-width=\"1.6\""},
};

CwStatus cw_picture_begin(CwPicture *picture, const char *path, double width, double height) {
  CwStatus status = CW_OK;
  CW_TRY(cw_atomic_file_open(path, &picture->file));
  fprintf(picture->file.stream,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
          "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" stroke-linejoin=\"round\">\n"
          "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
          width, height, width, height);
done:
  return status;
}

CwStatus cw_picture_end(CwPicture *picture) {
  fprintf(picture->file.stream, "</svg>\n");
  return cw_atomic_file_commit(&picture->file);
}

void cw_picture_abandon(CwPicture *picture) {
  cw_atomic_file_abandon(&picture->file);
}

void cw_picture_line(CwPicture *picture, CwStroke stroke, const double (*x)[2], int count, int closed) {
  FILE *stream = picture->file.stream;
  fprintf(stream, "<%s fill=\"%s\" stroke=\"%s\" %s points=\"", closed ? "polygon" : "polyline",
          closed ? "#d6e8f2" : "none", strokes[stroke].colour, strokes[stroke].style);
  for (int i = 0; i < count; i++) fprintf(stream, "%s%.2f,%.2f", i ? " " : "", x[i][0], x[i][1]);
  fprintf(stream, "\"/>\n");
}

void cw_picture_segment(CwPicture *picture, CwStroke stroke, double x0, double y0, double x1, double y1) {
  const double x[2][2] = {{x0, y0}, {x1, y1}};
  cw_picture_line(picture, stroke, x, 2, 0);
}

void cw_picture_arrow(CwPicture *picture, CwStroke stroke, double x0, double y0, double x1, double y1) {
  const double length = hypot(x1 - x0, y1 - y0), c = (x1 - x0) / length, s = (y1 - y0) / length;
  const double head = fmin(10, 0.5 * length), half = 0.35 * head;
  cw_picture_segment(picture, stroke, x0, y0, x1 - 0.8 * head * c, y1 - 0.8 * head * s);
  fprintf(picture->file.stream, "<polygon fill=\"%s\" points=\"%.2f,%.2f %.2f,%.2f %.2f,%.2f\"/>\n",
          strokes[stroke].colour, x1, y1, x1 - head * c + half * s, y1 - head * s - half * c, x1 - head * c - half * s,
          y1 - head * s + half * c);
}

void cw_picture_circle(CwPicture *picture, CwStroke stroke, double x, double y, double radius) {
  fprintf(picture->file.stream, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"none\" stroke=\"%s\" %s/>\n", x, y,
          radius, strokes[stroke].colour, strokes[stroke].style);
}

void cw_picture_text(CwPicture *picture, CwTextAlign align, double x, double y, const char *format, ...) {
  static const char *const anchor[] = {[CW_TEXT_LEFT] = "start", [CW_TEXT_MIDDLE] = "middle", [CW_TEXT_RIGHT] = "end"};
  char text[200];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  fprintf(picture->file.stream, "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"%s\" fill=\"#1f2933\">", x, y,
          anchor[align]);
  for (const char *c = text; *c; c++) {
    if (*c == '&')
      fputs("&amp;", picture->file.stream);
    else if (*c == '<')
      fputs("&lt;", picture->file.stream);
    else if (*c == '>')
      fputs("&gt;", picture->file.stream);
    else
      fputc(*c, picture->file.stream);
  }
  fputs("</text>\n", picture->file.stream);
}

void cw_picture_scale(CwPicture *picture, double x, double y, double pixels_per_mm) {
  const double step[] = {1, 2, 5};
  double best = 1e-3;
  for (int k = 0; k < 24; k++) {
    const double length = pow(10, -3 + k / 3) * step[k % 3];
    if (length * pixels_per_mm <= 170) best = length;
  }
  const double end = x + best * pixels_per_mm;
  cw_picture_segment(picture, CW_STROKE_WALL, x, y, end, y);
  cw_picture_segment(picture, CW_STROKE_WALL, x, y - 5, x, y + 5);
  cw_picture_segment(picture, CW_STROKE_WALL, end, y - 5, end, y + 5);
  cw_picture_text(picture, CW_TEXT_MIDDLE, 0.5 * (x + end), y - 8, "%g mm", best);
}
