// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/render.h"
#include "pipeline/report/streamlines.h"

static void average(const CwCanvas *canvas, unsigned char *pixels, int stride) {
  const int samples = CW_RENDER_SAMPLES * CW_RENDER_SAMPLES;
  for (int j = 0; j < canvas->height; j++) {
    uint32_t *row = (uint32_t *)(void *)(pixels + (size_t)j * (size_t)stride);
    for (int i = 0; i < canvas->width; i++) {
      unsigned sum[3] = {0};
      for (int s = 0; s < samples; s++) {
        size_t place = (size_t)(j * CW_RENDER_SAMPLES + s / CW_RENDER_SAMPLES) * (size_t)canvas->columns +
                       (size_t)(i * CW_RENDER_SAMPLES + s % CW_RENDER_SAMPLES);
        uint32_t colour = canvas->group[place] ? canvas->colour[place] : canvas->background;
        for (int c = 0; c < 3; c++) sum[c] += (colour >> (8 * c)) & 255;
      }
      row[i] = 0;
      for (int c = 0; c < 3; c++) row[i] |= ((sum[c] + samples / 2) / samples) << (8 * c);
    }
  }
}

static void ink(cairo_t *cr) {
  cairo_set_source_rgb(cr, 0.16, 0.19, 0.23);
}

// A light ground under the path, so that it stands out over any picture.
static void ground(cairo_t *cr, double width, double opacity) {
  cairo_set_source_rgba(cr, 1, 1, 1, opacity);
  cairo_set_line_width(cr, width);
  cairo_stroke_preserve(cr);
}

static void text_at(cairo_t *cr, double x, double y, const char *text) {
  cairo_move_to(cr, x, y);
  cairo_text_path(cr, text);
  ground(cr, 3.5, 0.85);
  ink(cr);
  cairo_fill(cr);
}

static void length_text(double metres, char *text, size_t size) {
  if (metres >= 1)
    snprintf(text, size, "%g m", metres);
  else if (metres >= 0.9999e-3)
    snprintf(text, size, "%g mm", metres * 1e3);
  else
    snprintf(text, size, "%g \302\265m", metres * 1e6);
}

static void scale_bar(cairo_t *cr, const CwCanvas *canvas, double metres_per_pixel) {
  char text[40];
  double metres = cw_render_round_length(0.22 * canvas->width * metres_per_pixel);
  double length = metres / metres_per_pixel, x = 16, y = canvas->height - 16;
  length_text(metres, text, sizeof text);
  cairo_move_to(cr, x, y - 5);
  cairo_line_to(cr, x, y);
  cairo_line_to(cr, x + length, y);
  cairo_line_to(cr, x + length, y - 5);
  ground(cr, 5, 0.85);
  ink(cr);
  cairo_set_line_width(cr, 1.6);
  cairo_stroke(cr);
  text_at(cr, x + 6, y - 6, text);
}

static void triad(cairo_t *cr, const CwCanvas *canvas, const CwAnnotation *annotation) {
  const double size = 30, x = canvas->width - 62, y = canvas->height - 62;
  for (int k = 0; k < annotation->axis_count; k++) {
    const CwTriadAxis *axis = &annotation->axis[k];
    double length = hypot(axis->direction[0], axis->direction[1]);
    if (length < 0.08) continue; // along the view
    double dx = axis->direction[0] * size, dy = axis->direction[1] * size, ux = dx / (length * size),
           uy = dy / (length * size);
    cairo_move_to(cr, x, y);
    cairo_line_to(cr, x + dx, y + dy);
    ground(cr, 4.5, 0.85);
    ink(cr);
    cairo_set_line_width(cr, 1.4);
    cairo_stroke(cr);
    cairo_move_to(cr, x + dx + 5 * ux, y + dy + 5 * uy);
    cairo_line_to(cr, x + dx - 2 * ux - 3 * uy, y + dy - 2 * uy + 3 * ux);
    cairo_line_to(cr, x + dx - 2 * ux + 3 * uy, y + dy - 2 * uy - 3 * ux);
    cairo_close_path(cr);
    cairo_fill(cr);
    text_at(cr, x + dx + 13 * ux - 4, y + dy + 13 * uy + 4, axis->name);
  }
}

static void frames(cairo_t *cr, const CwAnnotation *annotation) {
  for (int k = 0; k < annotation->frame_count; k++) {
    const CwInsetFrame *frame = &annotation->frame[k];
    cairo_rectangle(cr, frame->x, frame->y, frame->width, frame->height);
    ground(cr, 4, 0.8);
    cairo_set_source_rgb(cr, 0.72, 0.11, 0.11);
    cairo_set_line_width(cr, 1.6);
    cairo_stroke(cr);
    cairo_set_font_size(cr, 20);
    text_at(cr, frame->x + frame->width + 6, frame->y + 14, frame->text);
    cairo_set_font_size(cr, 13);
  }
}

static void labels(cairo_t *cr, const CwAnnotation *annotation) {
  cairo_set_font_size(cr, 16);
  for (int k = 0; k < annotation->label_count; k++) {
    const CwLabel *label = &annotation->label[k];
    cairo_text_extents_t box;
    cairo_text_extents(cr, label->text, &box);
    text_at(cr, label->x - box.x_bearing - 0.5 * box.width, label->y - box.y_bearing - 0.5 * box.height, label->text);
  }
  cairo_set_font_size(cr, 13);
}

static void arrow_head(cairo_t *cr, const double from[2], const double to[2]) {
  const double length = hypot(to[0] - from[0], to[1] - from[1]), size = 4.5;
  const double ux = (to[0] - from[0]) / length * size, uy = (to[1] - from[1]) / length * size;
  cairo_move_to(cr, to[0] + ux, to[1] + uy);
  cairo_line_to(cr, to[0] - ux - 0.7 * uy, to[1] - uy + 0.7 * ux);
  cairo_line_to(cr, to[0] - ux + 0.7 * uy, to[1] - uy - 0.7 * ux);
  cairo_close_path(cr);
  cairo_fill(cr);
}

// The streamlines of the canvas, with an arrow head in the middle of each.
static CwStatus streamlines(cairo_t *cr, const CwCanvas *canvas, double apart) {
  CwStatus status = CW_OK;
  CwStreamlines lines = {0};
  uint16_t *group = NULL;
  CW_NEW(group, (size_t)canvas->width * (size_t)canvas->height);
  for (int j = 0; j < canvas->height; j++)
    for (int i = 0; i < canvas->width; i++)
      group[j * canvas->width + i] =
          canvas->group[(size_t)j * CW_RENDER_SAMPLES * (size_t)canvas->columns + (size_t)i * CW_RENDER_SAMPLES];
  const CwPixelFlow flow = {canvas->width, canvas->height, (const float(*)[2])canvas->velocity, group};
  CW_TRY(cw_streamlines_make(&flow, apart, &lines));
  cairo_set_source_rgba(cr, 1, 1, 1, 0.7);
  cairo_set_line_width(cr, 0.9);
  for (int k = 0; k < lines.count; k++) {
    const int first = k ? lines.end[k - 1] : 0, end = lines.end[k], middle = (first + end) / 2;
    for (int i = first; i < end; i++) cairo_line_to(cr, lines.point[i][0], lines.point[i][1]);
    cairo_stroke(cr);
    arrow_head(cr, lines.point[middle - 1], lines.point[middle]);
  }
done:
  free(group);
  cw_streamlines_free(&lines);
  return status;
}

static cairo_status_t append(void *closure, const unsigned char *bytes, unsigned length) {
  CwPng *png = closure;
  unsigned char *grown = realloc(png->bytes, png->size + length);
  if (!grown) return CAIRO_STATUS_NO_MEMORY;
  memcpy(grown + png->size, bytes, length);
  png->bytes = grown;
  png->size += length;
  return CAIRO_STATUS_SUCCESS;
}

CwStatus cw_render_png(const CwCanvas *canvas, const CwAnnotation *annotation, CwPng *png) {
  CwStatus status = CW_OK;
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, canvas->width, canvas->height);
  cairo_t *cr = NULL;
  *png = (CwPng){0};
  CW_REQUIRE(cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS, CW_ERR_LIBRARY, "cairo: a picture of %d x %d: %s",
             canvas->width, canvas->height, cairo_status_to_string(cairo_surface_status(surface)));
  cairo_surface_flush(surface);
  average(canvas, cairo_image_surface_get_data(surface), cairo_image_surface_get_stride(surface));
  cairo_surface_mark_dirty(surface);
  cr = cairo_create(surface);
  cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, 13);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  if (annotation) {
    if (annotation->streamlines_apart > 0 && canvas->velocity)
      CW_TRY(streamlines(cr, canvas, annotation->streamlines_apart));
    labels(cr, annotation);
    if (annotation->metres_per_pixel > 0) scale_bar(cr, canvas, annotation->metres_per_pixel);
    triad(cr, canvas, annotation);
    frames(cr, annotation);
  }
  cairo_surface_flush(surface);
  cairo_status_t written = cairo_surface_write_to_png_stream(surface, append, png);
  CW_REQUIRE(written == CAIRO_STATUS_SUCCESS, CW_ERR_LIBRARY, "cairo: a picture of %d x %d cannot be written: %s",
             canvas->width, canvas->height, cairo_status_to_string(written));
done:
  if (cr) cairo_destroy(cr);
  cairo_surface_destroy(surface);
  if (status != CW_OK) cw_png_free(png);
  return status;
}

void cw_png_free(CwPng *png) {
  free(png->bytes);
  *png = (CwPng){0};
}
