// SPDX-License-Identifier: AGPL-3.0-or-later
// A surface patch that is to be meshed: its map, the size field, and the points and edges it is given.
#pragma once

#include <stdint.h>

#include "mesher/common/size_at.h"

// Point and first derivatives of the surface at (u,v), m. xu and xv may be NULL. It is asked inside of the
// polygon of the given edges only.
typedef void (*CwSurfaceAt)(const void *context, const double uv[2], double x[3], double xu[3], double xv[3]);

typedef struct {
  CwSurfaceAt surface;
  const void *surface_context;
  CwSizeAt size;
  const void *size_context;
  int32_t point_count; // given points, all on edges
  const double (*uv)[2];
  const double (*x)[3]; // exact positions of the given points (the map may differ by rounding)
  int32_t edge_count;
  const int32_t (*edge)[2];
  const uint8_t *boundary; // 1: bounds the patch (inside is by parity); 0: lies in it
  const char *name;        // for messages
  double largest;          // m: triangles larger than the equilateral one with such edges are halved where shorter
                           // ones are wanted; 0: none
} CwPatchInput;
