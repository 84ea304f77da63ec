// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_cavity.h"

#include <math.h>
#include <string.h>

#include "mesher/policy.h"

// Pattern search: steps of this share of the distance to a corner, then half and a quarter.
enum { STEPS = 3 };
static const double FIRST_STEP = 0.2;

#define D 0.57735026918962573
const double cw_tet_direction[14][3] = {{1, 0, 0},  {-1, 0, 0},  {0, 1, 0},   {0, -1, 0},  {0, 0, 1},
                                        {0, 0, -1}, {D, D, D},   {-D, D, D},  {D, -D, D},  {-D, -D, D},
                                        {D, D, -D}, {-D, D, -D}, {D, -D, -D}, {-D, -D, -D}};
#undef D

double cw_cavity_quality(CwCavity *cavity, const double p[3], double enough) {
  double least = INFINITY;
  for (int k = 0; k < cavity->count; k++) {
    const double **f = cavity->face[k];
    double q = cw_tet_quality(f[0], f[1], f[2], p);
    if (q >= least) continue;
    least = q;
    if (least > enough) continue;
    if (k > 0) {
      const double *kept[3];
      int to = k / 2;
      memcpy(kept, f, sizeof kept);
      memcpy(f, cavity->face[to], sizeof kept);
      memcpy(cavity->face[to], kept, sizeof kept);
    }
    break;
  }
  return least;
}

double cw_cavity_best(CwCavity *cavity, double p[3], double start) {
  double best = start, mean[3] = {0, 0, 0}, square = 0.0;
  for (int k = 0; k < cavity->count; k++) {
    for (int c = 0; c < 3; c++) {
      for (int i = 0; i < 3; i++) mean[i] += cavity->face[k][c][i] / (3.0 * cavity->count);
    }
  }
  for (int i = 0; i < 3; i++) square += (cavity->face[0][0][i] - p[i]) * (cavity->face[0][0][i] - p[i]);
  double q = cw_cavity_quality(cavity, mean, best);
  if (q > best) {
    best = q;
    memcpy(p, mean, sizeof mean);
  }
  int last = 0;
  double step = FIRST_STEP * sqrt(square);
  for (int halvings = 0; halvings < STEPS; halvings++, step *= 0.5) {
    for (int tries = 0, k = last; tries < 14; tries++, k = (k + 1) % 14) {
      double there[3];
      for (int i = 0; i < 3; i++) there[i] = p[i] + step * cw_tet_direction[k][i];
      q = cw_cavity_quality(cavity, there, best + cw_policy.least_gain);
      if (q <= best + cw_policy.least_gain) continue;
      best = q;
      memcpy(p, there, sizeof there);
      last = k;
      tries = -1; // on in the same direction
      k = (k + 13) % 14;
    }
  }
  return best;
}
