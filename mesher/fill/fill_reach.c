// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_reach.h"

#include <math.h>

#include "mesher/common/vec.h"
#include "mesher/policy.h"

// By two parts in 2^24, which is more than the error of rounding; below the least normal number no lengths lie.
static void round_outward(const double low[3], const double high[3], CwReachBox *box) {
  for (int i = 0; i < 3; i++) {
    box->low[i] = (float)(low[i] - 0x1p-23 * fabs(low[i]));
    box->high[i] = (float)(high[i] + 0x1p-23 * fabs(high[i]));
  }
}

void cw_reach_of_triangle(const double a[3], const double b[3], const double c[3], double size, double clearance,
                          CwReachBox *box, CwReachBall *ball) {
  double u[3], v[3], low[3], high[3], square = 0.0;
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  double uu = cw_dot(u, u), vv = cw_dot(v, v), uv = cw_dot(u, v), det = uu * vv - uv * uv;
  double p = 1.0 / 3.0, q = 1.0 / 3.0;
  if (det > 5e-13 * uu * vv) {
    p = 0.5 * vv * (uu - uv) / det;
    q = 0.5 * uu * (vv - uv) / det;
  }
  for (int i = 0; i < 3; i++) {
    double d = p * u[i] + q * v[i];
    ball->centre[i] = a[i] + d;
    square += d * d;
  }
  ball->edge = sqrt(2.0 * (uu + vv - uv) / 3.0);
  // The sphere of a needle would reach far: it is no use to keep points out of all of it.
  square = fmin(square, fmax(fmax(uu, vv), uu + vv - 2.0 * uv));
  ball->square = clearance * clearance * square;
  double radius = sqrt(ball->square), margin = clearance * cw_policy.boundary_distance * fmin(size, ball->edge);
  for (int i = 0; i < 3; i++) {
    low[i] = fmin(ball->centre[i] - radius, fmin(fmin(a[i], b[i]), c[i]) - margin);
    high[i] = fmax(ball->centre[i] + radius, fmax(fmax(a[i], b[i]), c[i]) + margin);
  }
  round_outward(low, high, box);
}

CwReachBox cw_reach_box(const double x[3], double radius) {
  CwReachBox box;
  double low[3], high[3];
  for (int i = 0; i < 3; i++) {
    low[i] = x[i] - radius;
    high[i] = x[i] + radius;
  }
  round_outward(low, high, &box);
  return box;
}

// Square of the distance of x to a triangle: over its inside by the normal, else by its three edges.
static double distance_square(const double x[3], const double a[3], const double b[3], const double c[3]) {
  double u[3], v[3], w[3];
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  cw_sub(x, a, w);
  double uu = cw_dot(u, u), uv = cw_dot(u, v), vv = cw_dot(v, v), wu = cw_dot(w, u), wv = cw_dot(w, v);
  double det = uu * vv - uv * uv, s = vv * wu - uv * wv, t = uu * wv - uv * wu;
  if (s >= 0.0 && t >= 0.0 && s + t <= det && det > 0.0) {
    double d[3];
    for (int i = 0; i < 3; i++) d[i] = w[i] - (s * u[i] + t * v[i]) / det;
    return cw_dot(d, d);
  }
  const double *corner[3] = {a, b, c};
  double least = INFINITY;
  for (int k = 0; k < 3; k++) {
    double e[3], f[3];
    cw_sub(corner[(k + 1) % 3], corner[k], e);
    cw_sub(x, corner[k], f);
    double ee = cw_dot(e, e), along = ee > 0.0 ? cw_dot(e, f) / ee : 0.0;
    along = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
    for (int i = 0; i < 3; i++) f[i] -= along * e[i];
    double square = cw_dot(f, f);
    if (square < least) least = square;
  }
  return least;
}

int cw_reach_is_near(const double a[3], const double b[3], const double c[3], const CwReachBall *ball, double h,
                     double clearance, const double x[3]) {
  double nearest = cw_policy.boundary_distance * clearance * (ball->edge < h ? ball->edge : h);
  return distance_square(x, a, b, c) < nearest * nearest;
}
