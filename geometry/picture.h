// SPDX-License-Identifier: AGPL-3.0-or-later
// Line drawings as SVG, written straight to a file. Coordinates are pixels, y down.
#pragma once

#include "geometry/design.h"
#include "pipeline/atomic_file.h"
#include "pipeline/status.h"

// Stroke styles.
typedef enum { CW_STROKE_WALL, CW_STROKE_BLADE, CW_STROKE_THIN, CW_STROKE_AXIS, CW_STROKE_FLOW } CwStroke;

typedef enum { CW_TEXT_LEFT, CW_TEXT_MIDDLE, CW_TEXT_RIGHT } CwTextAlign;

typedef struct {
  CwAtomicFile file; // zeroed: nothing open
} CwPicture;

CwStatus cw_picture_begin(CwPicture *picture, const char *path, double width, double height);
CwStatus cw_picture_end(CwPicture *picture);
void cw_picture_abandon(CwPicture *picture); // does nothing after cw_picture_end

// A line through `count` points x[i]; a closed one is filled with the light blade colour.
void cw_picture_line(CwPicture *picture, CwStroke stroke, const double (*x)[2], int count, int closed);
void cw_picture_segment(CwPicture *picture, CwStroke stroke, double x0, double y0, double x1, double y1);
void cw_picture_arrow(CwPicture *picture, CwStroke stroke, double x0, double y0, double x1, double y1);
void cw_picture_circle(CwPicture *picture, CwStroke stroke, double x, double y, double radius);
// printf style; & < > in the text are escaped.
void cw_picture_text(CwPicture *picture, CwTextAlign align, double x, double y, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
// A scale bar of a round length near 120 px, from (x, y) to the right, with its length above it.
void cw_picture_scale(CwPicture *picture, double x, double y, double pixels_per_mm);

// The pictures of the geometry stage.
CwStatus cw_picture_meridional(const CwDesign *design, const char *path);         // section (z, r)
CwStatus cw_picture_blade_plan(const CwDesign *design, const char *path);         // plan view at mid-span
CwStatus cw_picture_velocity_triangles(const CwDesign *design, const char *path); // inlet and outlet
CwStatus cw_picture_blade_angle(const CwDesign *design, const char *path);        // beta and area along the blade
CwStatus cw_picture_volute_sections(const CwDesign *design, const char *path);    // areas and outlines
CwStatus cw_picture_volute_plan(const CwDesign *design, const char *path);        // walls at z = 0
