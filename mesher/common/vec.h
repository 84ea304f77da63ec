// SPDX-License-Identifier: AGPL-3.0-or-later
// Beside the operations of pipeline/vec.h those that only the mesher needs.
#pragma once

#include "pipeline/vec.h"

// Of numbers, for inner loops: fmin and fmax, which look for NaN, are calls.
static inline double cw_lesser(double a, double b) {
  return a < b ? a : b;
}

static inline double cw_greater(double a, double b) {
  return a < b ? b : a;
}

// r = a + s (b - a)
static inline void cw_lerp(const double a[3], const double b[3], double s, double r[3]) {
  for (int k = 0; k < 3; k++) r[k] = a[k] + s * (b[k] - a[k]);
}

// The share of the way from a to b, 0 to 1, at which this comes nearest to x.
static inline double cw_nearest_share(const double a[3], const double b[3], const double x[3]) {
  double along[3], from[3];
  cw_sub(b, a, along);
  cw_sub(x, a, from);
  double square = cw_dot(along, along);
  return square > 0 ? fmin(fmax(cw_dot(from, along) / square, 0), 1) : 0;
}

// Twice the signed area of a, b, c in a plane: above 0 where they run counter-clockwise.
static inline double cw_twice_area(const double a[2], const double b[2], const double c[2]) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Takes out of a its part along the unit vector n.
static inline void cw_flatten(double a[3], const double n[3]) {
  double along = cw_dot(a, n);
  for (int k = 0; k < 3; k++) a[k] -= along * n[k];
}
