// SPDX-License-Identifier: AGPL-3.0-or-later
// A small software rasteriser: flat triangles with a depth buffer and with edge lines, orthographic views, 2
// x 2 samples a pixel, out as PNG. Lengths on the canvas are pixels of the finished picture, x to the right,
// y down; depth grows towards the viewer.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "pipeline/status.h"

enum { CW_RENDER_SAMPLES = 2 }; // along each side of a pixel

typedef struct {
  int width, height; // pixels of the finished picture
  int columns, rows; // samples
  int top, bottom;   // rows from `top` to `bottom` - 1 may have something on them
  uint32_t background;
  uint16_t *group;      // what the sample shows; 0: background. An outline is drawn where it changes.
  uint32_t *colour;     // 0xRRGGBB, where there is a group: what was never drawn on takes no memory
  float *depth;         // the same; NULL: none
  float (*velocity)[2]; // of each pixel where there is a group, as the last paint there has it; NULL: none
} CwCanvas;

// `depth_buffer` 0: later triangles cover earlier ones (flat pictures). CW_ERR_MEMORY.
CwStatus cw_render_start(int width, int height, uint32_t background, int depth_buffer, CwCanvas *canvas);
void cw_render_free(CwCanvas *canvas);
// Keeps velocities too, on a canvas on which nothing is drawn yet. CW_ERR_MEMORY.
CwStatus cw_render_keep_velocity(CwCanvas *canvas);

typedef struct {
  uint32_t colour, edge_colour; // 0xRRGGBB
  uint16_t group;               // from 1
  unsigned edges;               // bit k: draw the edge from corner k to corner k + 1
  double edge_width;            // px
  double edge_strength;         // 0: invisible to 1: opaque
  float velocity[2];            // to the right and downwards, in any unit
} CwPaint;

// Whether a polygon of `count` corners can hold samples of the canvas, by its box: most faces of a fine mesh lie
// between samples. None where a corner is not finite.
int cw_render_meets(const CwCanvas *canvas, const double (*p)[3], int count);
// Draws the triangle with corners p[k] = (x, y, depth). Parts outside the canvas are left out.
void cw_render_triangle(CwCanvas *canvas, const double p[3][3], const CwPaint *paint);
// Draws a convex polygon of `count` corners, its edges as lines (paint->edges is not read); with a depth
// buffer as a fan of triangles.
void cw_render_polygon(CwCanvas *canvas, const double (*p)[3], int count, const CwPaint *paint);

// Adds what was drawn on another canvas of the same size, `later` than what is on this one or earlier: the same samples
// as from all of it on one canvas.
void cw_render_merge(CwCanvas *canvas, const CwCanvas *other, int later);

// Darkens the borders between groups and, in pictures with a depth buffer, steps in depth of more than `step`
// (in units of the depth).
void cw_render_outline(CwCanvas *canvas, uint32_t colour, double step);
// Darkens hollows: samples whose surroundings within `radius` px lie nearer to the viewer. For pictures with
// a depth buffer; `unit` is the depth that is as long as one pixel.
void cw_render_occlusion(CwCanvas *canvas, double radius, double unit);

// Makes the samples of `group` background again.
void cw_render_erase(CwCanvas *canvas, uint16_t group);

// Where a group lies deepest within itself, for a text on it.
typedef struct {
  double x, y;  // px
  double depth; // px to the nearest sample of another group, along rows and columns; 0: none of it is to be seen
} CwGroupMiddle;

// Of groups 1 to `count`, that of group k in middle[k - 1], zeroed on entry. CW_ERR_MEMORY.
CwStatus cw_render_middles(const CwCanvas *canvas, int count, CwGroupMiddle *middle);

// 0xRRGGBB times a factor, limited to white.
uint32_t cw_render_shade(uint32_t colour, double factor);

// What is written over a finished picture.
typedef struct {
  const char *name;    // "x"
  double direction[2]; // on the canvas, y down; length 0 to 1
} CwTriadAxis;

typedef struct {
  const char *text; // may be ""
  double x, y, width, height;
} CwInsetFrame;

typedef struct {
  char text[16];
  double x, y; // px, in the middle of it
} CwLabel;

typedef struct {
  double metres_per_pixel; // for the scale bar
  CwTriadAxis axis[3];
  int axis_count;
  CwInsetFrame frame[4];
  int frame_count;
  CwLabel *label;
  int label_count;
  double streamlines_apart; // px; 0: none. On a canvas that keeps velocities.
} CwAnnotation;

typedef struct {
  unsigned char *bytes;
  size_t size;
} CwPng;

// Averages the samples and writes streamlines, labels, scale bar, axes and frames. Free with cw_png_free.
// CW_ERR_LIBRARY, CW_ERR_MEMORY.
CwStatus cw_render_png(const CwCanvas *canvas, const CwAnnotation *annotation, CwPng *png);
void cw_png_free(CwPng *png);

// The length of 1, 2 or 5 times a power of ten that is at most `limit`.
double cw_render_round_length(double limit);
