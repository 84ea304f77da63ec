// SPDX-License-Identifier: AGPL-3.0-or-later
// Triangles or lines as a VTK PolyData file, for a look at what a stage made.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

// A number of each triangle or line.
typedef struct {
  const char *name;
  const int32_t *value;
  const double *real; // in place of these, where it is given
} CwVtkField;

typedef struct {
  const char *title;
  int32_t point_count;
  const double (*x)[3]; // in the unit of lengths; written in m
  int32_t triangle_count;
  const int32_t (*triangle)[3];
  int field_count;
  const CwVtkField *field;
} CwVtkTriangles;

CwStatus cw_vtk_write(const char *path, const CwVtkTriangles *triangles);

// Polylines: line i runs through the points x[start[i]] .. x[start[i + 1] - 1].
typedef struct {
  const char *title;
  const double (*x)[3]; // in the unit of lengths; written in m
  int32_t line_count;
  const int32_t *start; // line_count + 1
  int field_count;
  const CwVtkField *field;
} CwVtkLines;

CwStatus cw_vtk_write_lines(const char *path, const CwVtkLines *lines);
