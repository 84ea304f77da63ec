// SPDX-License-Identifier: AGPL-3.0-or-later
// Which places a triangle of the boundary forbids to the inner points of a fill: those nearer than half of the
// wanted length h, or of the triangle's edges where these are shorter, and those in the smallest sphere through its
// corners, so that a Delaunay mesh of all points holds it. All distances can be multiplied by a clearance.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  float low[3], high[3]; // box of all places that can be forbidden, rounded outward
} CwReachBox;

typedef struct {
  double centre[3], square; // sphere
  double edge;              // of the triangle, root of the mean square
} CwReachBall;

// `size`: no h is longer in the box.
void cw_reach_of_triangle(const double a[3], const double b[3], const double c[3], double size, double clearance,
                          CwReachBox *box, CwReachBall *ball);
// The box of a ball.
CwReachBox cw_reach_box(const double x[3], double radius);

static inline int cw_reach_holds(const CwReachBox *box, const float p[3]) {
  return (p[0] >= box->low[0]) & (p[0] <= box->high[0]) & (p[1] >= box->low[1]) & (p[1] <= box->high[1]) &
         (p[2] >= box->low[2]) & (p[2] <= box->high[2]);
}

// Whether x is nearer to the triangle than is allowed where h is wanted.
int cw_reach_is_near(const double a[3], const double b[3], const double c[3], const CwReachBall *ball, double h,
                     double clearance, const double x[3]);
// Whether it is in the sphere.
static inline int cw_reach_in_ball(const CwReachBall *ball, const double x[3]) {
  double u = x[0] - ball->centre[0], v = x[1] - ball->centre[1], w = x[2] - ball->centre[2];
  return u * u + v * v + w * w < ball->square;
}

#ifdef __cplusplus
}
#endif
