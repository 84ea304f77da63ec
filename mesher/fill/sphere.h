// SPDX-License-Identifier: AGPL-3.0-or-later
// Circumscribed spheres of tetrahedra while points are connected: in single precision, with a bound of their error.
#ifndef CUTWATER_MESHER_FILL_SPHERE_H
#define CUTWATER_MESHER_FILL_SPHERE_H

#include <math.h>
#include <stdint.h>

#include "mesher/common/number.h"
#include "mesher/fill/delaunay.h"

#ifdef __cplusplus
extern "C" {
#endif

// Where a place lies to a sphere; and that the tetrahedron is taken, in the cavity of the new point already.
enum { CW_WITHIN = 1, CW_BEYOND = 2, CW_TAKEN = 4 };

// Spheres are seen from the middle of all points and in a unit of which no point is farther from it than one. `scale`
// is one over that unit.
typedef struct {
  double middle[3], scale;
} CwSphereFrame;

// With u = 2^-24 centres and points are rounded by u (1 + r) and u at most, r being the radius; so the square of a
// distance of r from the true centre, less that of the radius, is off by less than u (4 r + 8 r^2), of which the square
// is below u^2 r^2 (32 + 128 r^2). A quarter more leaves room for errors of second order and of the sphere in double
// precision; what is nearer is left to the exact predicate.
#define CW_SPHERE_UNSURE_NEAR (40.0f * 0x1p-48f)
#define CW_SPHERE_UNSURE_FAR (160.0f * 0x1p-48f)
// Two conditions for that: u is little beside r; and, with P the product of the three edge lengths from one corner, the
// error of the centre in double precision, which is below 32 eps P / |det| radii and counts four times, is so beside u.
#define CW_SPHERE_SMALL 1e-10    // below radius^2
#define CW_SPHERE_SLENDER 2.4e11 // above P^2 / det^2

// From the corners of the tetrahedron that encloses all points: at (1, 1, 1), (-1, -1, 1), ... times four units at
// least from their middle.
static inline CwSphereFrame cw_sphere_frame(const double a[3], const double b[3], const double c[3],
                                            const double d[3]) {
  CwSphereFrame frame;
  for (int i = 0; i < 3; i++) frame.middle[i] = 0.25 * a[i] + 0.25 * b[i] + 0.25 * c[i] + 0.25 * d[i];
  frame.scale = 8.0 / (a[0] - b[0]);
  return frame;
}

static inline void cw_sphere_place(const CwSphereFrame *frame, const double x[3], double place[3]) {
  for (int i = 0; i < 3; i++) place[i] = (x[i] - frame->middle[i]) * frame->scale;
}

// Marks a tetrahedron as taken (1), or leaves it as it is (0): the square of its radius has its sign set then, also
// where it is not a number.
static inline void cw_sphere_take(CwDelaunayTet *t, uint32_t taken) {
  t->mark |= taken << 31;
}

// CW_WITHIN or CW_BEYOND, or 0 where that is not sure; with CW_TAKEN where it is taken, and then never CW_WITHIN.
static inline unsigned cw_sphere_compare(const CwDelaunayTet *t, const float place[3]) {
  float x = place[0] - t->centre[0], y = place[1] - t->centre[1], z = place[2] - t->centre[2],
        square = t->radius_square;
  float over = x * x + y * y + z * z - square;
  unsigned sure = cw_number(over * over > square * (CW_SPHERE_UNSURE_FAR * square + CW_SPHERE_UNSURE_NEAR));
  return sure + (sure & cw_number(over > 0.0f)) + CW_TAKEN * (t->mark >> 31);
}

// The sphere through the point at `place` and three points at a, b, c from it, in the unit of the frame; the fourth of
// each is the square of its distance. No tetrahedron is taken at first.
static inline void cw_sphere_set(CwDelaunayTet *t, const double place[3], const double a[4], const double b[4],
                                 const double c[4]) {
  double bcx = b[1] * c[2] - b[2] * c[1], bcy = b[2] * c[0] - b[0] * c[2], bcz = b[0] * c[1] - b[1] * c[0];
  double cax = c[1] * a[2] - c[2] * a[1], cay = c[2] * a[0] - c[0] * a[2], caz = c[0] * a[1] - c[1] * a[0];
  double abx = a[1] * b[2] - a[2] * b[1], aby = a[2] * b[0] - a[0] * b[2], abz = a[0] * b[1] - a[1] * b[0];
  double det = a[0] * bcx + a[1] * bcy + a[2] * bcz, half = 0.5 / det;
  double x = (a[3] * bcx + b[3] * cax + c[3] * abx) * half;
  double y = (a[3] * bcy + b[3] * cay + c[3] * aby) * half;
  double z = (a[3] * bcz + b[3] * caz + c[3] * abz) * half;
  double square = x * x + y * y + z * z;
  int good = a[3] * b[3] * c[3] < CW_SPHERE_SLENDER * det * det && square > CW_SPHERE_SMALL;
  t->centre[0] = (float)(place[0] + x);
  t->centre[1] = (float)(place[1] + y);
  t->centre[2] = (float)(place[2] + z);
  t->radius_square = good ? (float)square : NAN;
}

#ifdef __cplusplus
}
#endif
#endif
