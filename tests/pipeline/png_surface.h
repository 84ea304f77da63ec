// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cairo.h>
#include <string.h>

#include "pipeline/report/render.h"
#include "tests/unit_test.h"

typedef struct {
  const CwPng *png;
  size_t at;
} PngStream;

static inline cairo_status_t png_take(void *closure, unsigned char *into, unsigned length) {
  PngStream *stream = closure;
  if (stream->at + length > stream->png->size) return CAIRO_STATUS_READ_ERROR;
  memcpy(into, stream->png->bytes + stream->at, length);
  stream->at += length;
  return CAIRO_STATUS_SUCCESS;
}

// The picture as cairo reads it back; the caller destroys it.
static inline cairo_surface_t *png_surface(const CwPng *png) {
  PngStream stream = {png, 0};
  cairo_surface_t *surface = cairo_image_surface_create_from_png_stream(png_take, &stream);
  assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
  return surface;
}

// The colour of a pixel, without its opacity.
static inline uint32_t png_pixel(cairo_surface_t *surface, int i, int j) {
  uint32_t value;
  memcpy(&value, cairo_image_surface_get_data(surface) + j * cairo_image_surface_get_stride(surface) + 4 * i, 4);
  return value & 0xffffff;
}
