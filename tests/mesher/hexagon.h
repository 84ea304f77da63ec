// SPDX-License-Identifier: AGPL-3.0-or-later
// A wall of six equilateral triangles of side 2 about point 0, in the plane z = 0, with the fluid above it.
#pragma once

#include "mesher/layers/layer_input.h"
#include "tests/unit_test.h"

typedef struct {
  double x[7][3], target[7];
  int32_t triangle[6][3];
  CwLayerInput in;
} Hexagon;

// `in` points into it: it stays where it is.
static inline void hexagon_make(Hexagon *wall) {
  *wall = (Hexagon){.in = {.point_count = 7, .triangle_count = 6}};
  for (int k = 0; k < 6; k++) {
    wall->x[k + 1][0] = 2 * cos(k * M_PI / 3);
    wall->x[k + 1][1] = 2 * sin(k * M_PI / 3);
    wall->triangle[k][1] = 1 + (k + 1) % 6; // the normal points out of the fluid
    wall->triangle[k][2] = 1 + k;
  }
  for (int v = 0; v < 7; v++) wall->target[v] = 1;
  wall->in.x = (const double(*)[3])wall->x;
  wall->in.triangle = (const int32_t(*)[3])wall->triangle;
  wall->in.target = wall->target;
}
