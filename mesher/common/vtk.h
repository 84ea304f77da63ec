// SPDX-License-Identifier: AGPL-3.0-or-later
// Triangles as a VTK PolyData file, for a look at what a stage made.
#ifndef CUTWATER_MESHER_COMMON_VTK_H
#define CUTWATER_MESHER_COMMON_VTK_H

#include <stdint.h>

#include "pipeline/status.h"

// A whole number of each triangle.
typedef struct {
  const char *name;
  const int32_t *value;
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

#endif
