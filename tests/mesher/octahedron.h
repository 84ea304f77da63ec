// SPDX-License-Identifier: AGPL-3.0-or-later
// A closed background triangulation small enough to know by heart: |x| + |y| + |z| = 1, and inside it, where
// `hollow`, the same turned in at 1/4 of the size: a hole in the domain.
#pragma once

#include <stdint.h>

#include "mesher/cad/background.h"

typedef struct {
  double x[12][3];
  int32_t triangle[16][3];
} Octahedron;

static inline CwBackground octahedron(Octahedron *shape, int hollow) {
  for (int i = 0; i < 12; i++) {
    for (int k = 0; k < 3; k++) shape->x[i][k] = 0;
    shape->x[i][i % 6 / 2] = (i % 2 ? -1.0 : 1.0) * (i < 6 ? 1.0 : 0.25);
  }
  for (int t = 0; t < 16; t++) {
    int sign[3] = {t & 1, t >> 1 & 1, t >> 2 & 1}, base = t < 8 ? 0 : 6;
    int turned = ((sign[0] + sign[1] + sign[2]) & 1) != (t >= 8);
    shape->triangle[t][0] = base + sign[0];
    shape->triangle[t][1] = base + (turned ? 4 + sign[2] : 2 + sign[1]);
    shape->triangle[t][2] = base + (turned ? 2 + sign[1] : 4 + sign[2]);
  }
  CwBackground background = {0};
  background.point_count = hollow ? 12 : 6;
  background.triangle_count = hollow ? 16 : 8;
  background.x = shape->x;
  background.triangle = shape->triangle;
  return background;
}
