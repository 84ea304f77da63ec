// SPDX-License-Identifier: AGPL-3.0-or-later
// Shape of single cells: volumes, angles, edge ratios. Shared by the audit and by the optimisation of the
// tetrahedra.
#pragma once

#include "pipeline/vec.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double volume;                            // m3, signed
  double edge_shortest, edge_longest;       // m
  double dihedral_least, dihedral_greatest; // degrees; 0 and 180 where the volume is not positive
  double mean_ratio; // 12 (3 V)^(2/3) over the sum of squared edges (Liu and Joe 1994): 1 regular, 0 flat or turned
} CwTetShape;

// Six times the signed volume, m3: positive where (b - a) x (c - a) points towards d.
static inline double cw_tet_volume6(const double a[3], const double b[3], const double c[3], const double d[3]) {
  double px = b[0] - a[0], py = b[1] - a[1], pz = b[2] - a[2];
  double qx = c[0] - a[0], qy = c[1] - a[1], qz = c[2] - a[2];
  double rx = d[0] - a[0], ry = d[1] - a[1], rz = d[2] - a[2];
  return (py * qz - pz * qy) * rx + (pz * qx - px * qz) * ry + (px * qy - py * qx) * rz;
}
// A bound of the rounding error of cw_tet_volume6: a larger value has the right sign.
double cw_tet_volume6_error(const double a[3], const double b[3], const double c[3], const double d[3]);
void cw_tet_shape(const double *const x[4], CwTetShape *shape);

// Least over the six corners of a prism of the triple product of its unit edges, over that of the right prism
// on an equilateral triangle: 1 is best, not above 0 is inverted at a corner.
double cw_prism_scaled_jacobian(const double *const x[6]);

#ifdef __cplusplus
}
#endif
