// SPDX-License-Identifier: AGPL-3.0-or-later
// Vectors of three doubles, and degrees.
#pragma once

#include <math.h>

#define CW_DEGREE (M_PI / 180.0) // rad

static inline double cw_dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double cw_norm(const double a[3]) {
  return sqrt(cw_dot(a, a));
}

static inline void cw_sub(const double a[3], const double b[3], double r[3]) {
  for (int k = 0; k < 3; k++) r[k] = a[k] - b[k];
}

static inline void cw_copy(const double a[3], double r[3]) {
  for (int k = 0; k < 3; k++) r[k] = a[k];
}

static inline double cw_distance(const double a[3], const double b[3]) {
  double d[3];
  cw_sub(a, b, d);
  return cw_norm(d);
}

static inline void cw_cross(const double a[3], const double b[3], double r[3]) {
  double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  r[0] = x, r[1] = y, r[2] = z;
}

// (b - a) x (c - a): as long as twice the area of the triangle.
static inline void cw_normal(const double a[3], const double b[3], const double c[3], double n[3]) {
  double u[3], v[3];
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  cw_cross(u, v, n);
}

// Scales a to unit length (leaves a zero vector) and returns its length before.
static inline double cw_unit(double a[3]) {
  double length = cw_norm(a);
  if (length > 0) {
    for (int k = 0; k < 3; k++) a[k] /= length;
  }
  return length;
}
