// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/interface_tolerance.h"

#include <math.h>

static const double SHARE = 0.01; // of the shortest edge

double cw_interface_tolerance(int count, const double *const nodes[4]) {
  double shortest = INFINITY;
  for (int i = 0; i < count; ++i) {
    const double *a = nodes[i], *b = nodes[(i + 1) % count];
    shortest = fmin(shortest, hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]));
  }
  return SHARE * shortest;
}
