// SPDX-License-Identifier: AGPL-3.0-or-later
// Geometric predicates whose signs are always right: double arithmetic with an error bound, and exact
// arithmetic where the bound leaves the sign open (J. R. Shewchuk, Discrete & Computational Geometry 18,
// 1997; the code that TetGen has of it). Right for coordinates whose fifth powers neither overflow nor underflow, and
// only without contraction of a * b + c.
#pragma once

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

// The same by as much arithmetic as it takes: -1, 0 or 1. For signs that plain doubles leave open.
int cw_orient3d_exact(const double a[3], const double b[3], const double c[3], const double d[3]);
int cw_insphere_exact(const double a[3], const double b[3], const double c[3], const double d[3], const double e[3]);

// Bounds of the relative rounding error, in units of 2^-53: 7 and 16 operations deep, with a margin for
// second order.
#define CW_ORIENT3D_BOUND (7.1 * 0x1p-53)
#define CW_INSPHERE_BOUND (16.1 * 0x1p-53)

// Sign of (b - a) x (c - a) . (d - a): 1 where the tetrahedron (a, b, c, d) is positive, 0 where the points
// are coplanar.
static inline int cw_orient3d(const double a[3], const double b[3], const double c[3], const double d[3]) {
  double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  double dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
  double p = by * cz, q = bz * cy, r = bz * cx, s = bx * cz, t = bx * cy, u = by * cx;
  double det = (p - q) * dx + (r - s) * dy + (t - u) * dz;
  double size = (fabs(p) + fabs(q)) * fabs(dx) + (fabs(r) + fabs(s)) * fabs(dy) + (fabs(t) + fabs(u)) * fabs(dz);
  if (det > CW_ORIENT3D_BOUND * size) return 1;
  if (det < -CW_ORIENT3D_BOUND * size) return -1;
  return cw_orient3d_exact(a, b, c, d);
}

// 1 where e lies inside the sphere through the corners of the positive tetrahedron (a, b, c, d), -1 outside,
// 0 on it.
static inline int cw_insphere(const double a[3], const double b[3], const double c[3], const double d[3],
                              const double e[3]) {
  double v[4][3], square[4];
  const double *corner[4] = {a, b, c, d};
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < 3; i++) v[k][i] = corner[k][i] - e[i];
    square[k] = v[k][0] * v[k][0] + v[k][1] * v[k][1] + v[k][2] * v[k][2];
  }
  // Minors of the first two columns, and their sizes; then of three, by the last column.
  double ab1 = v[0][0] * v[1][1], ab2 = v[1][0] * v[0][1], bc1 = v[1][0] * v[2][1], bc2 = v[2][0] * v[1][1];
  double cd1 = v[2][0] * v[3][1], cd2 = v[3][0] * v[2][1], da1 = v[3][0] * v[0][1], da2 = v[0][0] * v[3][1];
  double ac1 = v[0][0] * v[2][1], ac2 = v[2][0] * v[0][1], bd1 = v[1][0] * v[3][1], bd2 = v[3][0] * v[1][1];
  double ab = ab1 - ab2, bc = bc1 - bc2, cd = cd1 - cd2, da = da1 - da2, ac = ac1 - ac2, bd = bd1 - bd2;
  double za = v[0][2], zb = v[1][2], zc = v[2][2], zd = v[3][2];
  double abc = za * bc - zb * ac + zc * ab, bcd = zb * cd - zc * bd + zd * bc;
  double cda = zc * da + zd * ac + za * cd, dab = zd * ab + za * bd + zb * da;
  double det = (square[2] * dab - square[3] * abc) + (square[0] * bcd - square[1] * cda);
  double sab = fabs(ab1) + fabs(ab2), sbc = fabs(bc1) + fabs(bc2), scd = fabs(cd1) + fabs(cd2);
  double sda = fabs(da1) + fabs(da2), sac = fabs(ac1) + fabs(ac2), sbd = fabs(bd1) + fabs(bd2);
  za = fabs(za), zb = fabs(zb), zc = fabs(zc), zd = fabs(zd);
  double size = (za * sbc + zb * sac + zc * sab) * square[3] + (zb * scd + zc * sbd + zd * sbc) * square[0] +
                (zc * sda + zd * sac + za * scd) * square[1] + (zd * sab + za * sbd + zb * sda) * square[2];
  if (det > CW_INSPHERE_BOUND * size) return 1;
  if (det < -CW_INSPHERE_BOUND * size) return -1;
  return cw_insphere_exact(a, b, c, d, e);
}

#ifdef __cplusplus
}
#endif
