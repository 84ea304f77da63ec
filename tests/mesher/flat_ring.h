// SPDX-License-Identifier: AGPL-3.0-or-later
// A flat ring of four equal passages with the copies of its nodes: 10 to 20 mm from the axis, fluid above.
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "mesher/boundary/boundary.h"

enum { PASSAGES = 4, OF_PASSAGE = 16, AROUND = PASSAGES * OF_PASSAGE, RINGS = 10 };
enum { POINTS = AROUND * (RINGS + 1), TRIANGLES = 2 * AROUND * RINGS };

typedef struct {
  double x[POINTS][3];
  int32_t triangle[TRIANGLES][3], source[TRIANGLES], next[POINTS], turns[POINTS];
  CwSymmetry symmetry;
} FlatRing;

// The point on ray i and ring j.
static inline int32_t ring_point(int i, int j) {
  return i % AROUND * (RINGS + 1) + j;
}

static inline void flat_ring(FlatRing *ring) {
  int32_t count = 0;
  memset(ring, 0, sizeof *ring);
  ring->symmetry.count = PASSAGES;
  for (int i = 0; i < AROUND; i++) {
    double angle = 2 * M_PI * i / AROUND;
    for (int j = 0; j <= RINGS; j++) {
      int32_t v = ring_point(i, j);
      ring->x[v][0] = (10e-3 + j * 1e-3) * cos(angle);
      ring->x[v][1] = (10e-3 + j * 1e-3) * sin(angle);
      ring->next[v] = ring_point(i + OF_PASSAGE, j);
      ring->turns[v] = i / OF_PASSAGE;
    }
    for (int j = 0; j < RINGS; j++) {
      const int32_t corner[2][3] = {{ring_point(i, j), ring_point(i + 1, j), ring_point(i + 1, j + 1)},
                                    {ring_point(i, j), ring_point(i + 1, j + 1), ring_point(i, j + 1)}};
      for (int k = 0; k < 2; k++, count++) {
        memcpy(ring->triangle[count], corner[k], sizeof corner[k]);
        ring->source[count] = count % (TRIANGLES / PASSAGES);
      }
    }
  }
}

static inline CwNodeImages ring_images(FlatRing *ring) {
  return (CwNodeImages){.capacity = POINTS, .next = ring->next, .turns = ring->turns};
}
