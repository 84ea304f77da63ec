// SPDX-License-Identifier: AGPL-3.0-or-later
// Points sorted into equal cubes, to find those near a place.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

typedef struct {
  double low[3], size;
  int32_t count[3];
  int32_t *start;  // of each cube in member, x fastest; one more at the end
  int32_t *member; // points of each cube, ascending
} CwCubes;

// Cubes of edge `size` (m) over all points, or larger where that would be more than 256 along an axis.
CwStatus cw_cubes_make(int32_t count, const double (*x)[3], double size, CwCubes *cubes);
void cw_cubes_free(CwCubes *cubes);

// The cubes that hold all points within `radius` of x: from[k]..to[k] along each axis. Empty (from > to) where
// there are none.
void cw_cubes_near(const CwCubes *cubes, const double x[3], double radius, int32_t from[3], int32_t to[3]);

// Number of the cube a, b, c; those along x follow one another.
static inline size_t cw_cube(const CwCubes *cubes, int32_t a, int32_t b, int32_t c) {
  return ((size_t)c * (size_t)cubes->count[1] + (size_t)b) * (size_t)cubes->count[0] + (size_t)a;
}
