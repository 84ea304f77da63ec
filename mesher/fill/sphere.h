// SPDX-License-Identifier: AGPL-3.0-or-later
// Circumscribed spheres of tetrahedra while points are connected: in single precision, with a bound of their error.
#pragma once

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "mesher/common/branchless.h"
#include "mesher/common/simd_4f.h"
#include "mesher/fill/tet_mesh.h"

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
static inline void cw_sphere_take(CwTet *t, uint32_t taken) {
  t->mark |= taken << 31;
}

// CW_WITHIN or CW_BEYOND, or 0 where that is not sure; with CW_TAKEN where it is taken, and then never CW_WITHIN.
static inline unsigned cw_sphere_compare(const CwTet *t, const float place[3]) {
  float x = place[0] - t->centre[0], y = place[1] - t->centre[1], z = place[2] - t->centre[2],
        square = t->radius_square;
  float over = x * x + y * y + z * z - square;
  unsigned sure = cw_branchless(over * over > square * (CW_SPHERE_UNSURE_FAR * square + CW_SPHERE_UNSURE_NEAR));
  return sure + (sure & cw_branchless(over > 0.0f)) + CW_TAKEN * (t->mark >> 31);
}

// The same for four at once, whose answers agree with those one by one to the bit.
static inline void cw_sphere_compare_4(const CwTet *const t[4], const float place[3], int32_t known[4]) {
  Cw4f sphere[4];
  for (int k = 0; k < 4; k++) memcpy(&sphere[k], t[k]->centre, sizeof *sphere);
  cw_4f_transpose(sphere);
  Cw4f x = place[0] - sphere[0], y = place[1] - sphere[1], z = place[2] - sphere[2], square = sphere[3];
  Cw4f over = x * x + y * y + z * z - square;
  Cw4fMask sure = over * over > square * (CW_SPHERE_UNSURE_FAR * square + CW_SPHERE_UNSURE_NEAR);
  Cw4fMask taken = (Cw4fMask)square >> 31 & CW_TAKEN, all = taken - sure - (sure & (over > 0.0f));
  memcpy(known, &all, sizeof all);
}

// Two numbers in double precision that are reckoned with side by side.
typedef double CwTwo __attribute__((vector_size(2 * sizeof(double))));

// The spheres of two tetrahedra, which may be one, each through the point at `place` and three points at a, b, c from
// it, in the unit of the frame; the fourth of each is the square of its distance. They are not taken at first.
static inline void cw_sphere_set(CwTet *const tet[2], const double place[3], const double *const a[2],
                                 const double *const b[2], const double *const c[2]) {
  CwTwo p[4], q[4], r[4];
  for (int i = 0; i < 4; i++) {
    p[i] = (CwTwo){a[0][i], a[1][i]};
    q[i] = (CwTwo){b[0][i], b[1][i]};
    r[i] = (CwTwo){c[0][i], c[1][i]};
  }
  CwTwo qrx = q[1] * r[2] - q[2] * r[1], qry = q[2] * r[0] - q[0] * r[2], qrz = q[0] * r[1] - q[1] * r[0];
  CwTwo rpx = r[1] * p[2] - r[2] * p[1], rpy = r[2] * p[0] - r[0] * p[2], rpz = r[0] * p[1] - r[1] * p[0];
  CwTwo pqx = p[1] * q[2] - p[2] * q[1], pqy = p[2] * q[0] - p[0] * q[2], pqz = p[0] * q[1] - p[1] * q[0];
  CwTwo det = p[0] * qrx + p[1] * qry + p[2] * qrz, half = 0.5 / det;
  CwTwo x = (p[3] * qrx + q[3] * rpx + r[3] * pqx) * half;
  CwTwo y = (p[3] * qry + q[3] * rpy + r[3] * pqy) * half;
  CwTwo z = (p[3] * qrz + q[3] * rpz + r[3] * pqz) * half;
  CwTwo square = x * x + y * y + z * z, edges = p[3] * q[3] * r[3], most = CW_SPHERE_SLENDER * det * det;
  x += place[0], y += place[1], z += place[2];
  for (int k = 0; k < 2; k++) {
    int good = edges[k] < most[k] && square[k] > CW_SPHERE_SMALL;
    tet[k]->centre[0] = (float)x[k];
    tet[k]->centre[1] = (float)y[k];
    tet[k]->centre[2] = (float)z[k];
    tet[k]->radius_square = good ? (float)square[k] : NAN;
  }
}
