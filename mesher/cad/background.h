// SPDX-License-Identifier: AGPL-3.0-or-later
// The background triangulation: a fine tessellation of each CAD face, welded into one closed surface, with
// (u,v) kept for every corner. What the size field samples and the planner clips; no node of it goes into the
// mesh. Made by background_make.h.
#pragma once

#include <stdint.h>

#include "mesher/common/vtk.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int32_t point_count, triangle_count;
  double (*x)[3];          // m
  int32_t (*triangle)[3];  // normal out of the domain
  int32_t *face;           // CAD face of each triangle
  double (*uv)[3][2];      // of each corner on that face
  int32_t (*neighbour)[3]; // the triangle across edge (k, k+1) of each
  struct CwRays *rays;     // through it (rays.h)
} CwBackground;

void cw_background_free(CwBackground *background);

// Unit normal of triangle t, out of the domain; zero where it has no area.
void cw_background_normal(const CwBackground *background, int32_t t, double n[3]);

// Area of triangle t, m2, and its centre.
double cw_background_area(const CwBackground *background, int32_t t, double centre[3]);

// The triangles with a number of each, as a VTK file.
CwStatus cw_background_vtk(const CwBackground *background, const char *title, const CwVtkField *field,
                           const char *path);

// Volume enclosed, m3.
double cw_background_volume(const CwBackground *background);

#ifdef __cplusplus
}
#endif
