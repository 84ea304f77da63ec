// SPDX-License-Identifier: AGPL-3.0-or-later
// The quality that the improvement of tetrahedra raises; for inner loops: inline, without calls of the
// library.
#pragma once

#include <math.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "pipeline/mesh/cell.h"

typedef struct {
  double six;     // times the volume
  double edge[6]; // squares: ab, ac, ad, bc, bd, cd
  double area[4]; // squares of the doubled areas, opposite a, b, c, d
} CwTetMeasures;

static inline __attribute__((always_inline)) CwTetMeasures cw_tet_measures(const double a[3], const double b[3],
                                                                           const double c[3], const double d[3]) {
  CwTetMeasures s;
  double px = b[0] - a[0], py = b[1] - a[1], pz = b[2] - a[2];
  double qx = c[0] - a[0], qy = c[1] - a[1], qz = c[2] - a[2];
  double rx = d[0] - a[0], ry = d[1] - a[1], rz = d[2] - a[2];
  double ux = py * qz - pz * qy, uy = pz * qx - px * qz, uz = px * qy - py * qx; // p x q, opposite d
  double vx = qy * rz - qz * ry, vy = qz * rx - qx * rz, vz = qx * ry - qy * rx; // q x r, opposite b
  double wx = ry * pz - rz * py, wy = rz * px - rx * pz, wz = rx * py - ry * px; // r x p, opposite c
  double nx = ux + vx + wx, ny = uy + vy + wy, nz = uz + vz + wz;                // (q - p) x (r - p), opposite a
  double ex = qx - px, ey = qy - py, ez = qz - pz, fx = rx - px, fy = ry - py, fz = rz - pz;
  double gx = rx - qx, gy = ry - qy, gz = rz - qz;
  s.six = ux * rx + uy * ry + uz * rz;
  s.area[3] = ux * ux + uy * uy + uz * uz;
  s.area[1] = vx * vx + vy * vy + vz * vz;
  s.area[2] = wx * wx + wy * wy + wz * wz;
  s.area[0] = nx * nx + ny * ny + nz * nz;
  s.edge[0] = px * px + py * py + pz * pz;
  s.edge[1] = qx * qx + qy * qy + qz * qz;
  s.edge[2] = rx * rx + ry * ry + rz * rz;
  s.edge[3] = ex * ex + ey * ey + ez * ez;
  s.edge[4] = fx * fx + fy * fy + fz * fz;
  s.edge[5] = gx * gx + gy * gy + gz * gz;
  return s;
}

static inline void cw_tet_edges(const CwTetMeasures *s, double *shortest, double *longest) {
  const double *l = s->edge;
  *shortest = cw_lesser(cw_lesser(cw_lesser(l[0], l[1]), cw_lesser(l[2], l[3])), cw_lesser(l[4], l[5]));
  *longest = cw_greater(cw_greater(cw_greater(l[0], l[1]), cw_greater(l[2], l[3])), cw_greater(l[4], l[5]));
}

// Of the edges, the root of the mean square.
static inline double cw_tet_mean_edge(const CwTetMeasures *s) {
  const double *l = s->edge;
  return sqrt((l[0] + l[1] + l[2] + l[3] + l[4] + l[5]) / 6.0);
}

// checkMesh's determinant: that of the sum of S S^T / a^2 over the inner faces, S being their area vectors and a the
// mean of their areas, over 8. Bit i of `open` is set where the face opposite corner i lies on the boundary. As the S
// of all four add up to 0, the sum's is (9 V^2 / 2)^2 without one of them and 4 times that with all; 0 where two or
// more are open.
static inline double cw_tet_determinant(const CwTetMeasures *s, int open) {
  double sum = 0.0;
  int inner = 0;
  for (int i = 0; i < 4; i++) {
    if (open >> i & 1) continue;
    sum += 0.5 * sqrt(s->area[i]);
    inner++;
  }
  if (inner < 3) return 0.0;
  double mean = sum / inner, root = (inner == 4 ? 2.0 : 1.0) * s->six * s->six / (8.0 * mean * mean * mean);
  return root * root / 8.0;
}

// A determinant over the least that checkMesh does not call small, as sines of dihedral angles compare: of flat
// tetrahedra it goes with the fourth power of these.
static inline double cw_tet_determinant_share(double determinant) {
  return sqrt(sqrt(determinant / CW_SMALL_DETERMINANT));
}

// Least six volumes over the cube of the longest edge, squared: flatter ones are lost in rounding.
#define CW_TET_FLAT 1e-16

// What an aspect of 4 counts, as a square: the sine of 25 degrees; see below.
#define CW_TET_SLENDER 0.1786
// 16 times that: shortest over longest edge, squared, times this is the square of what the aspect counts.
#define CW_TET_ASPECT (16.0 * CW_TET_SLENDER)

// Least sine of the dihedral angles, and not above 1.69 shortest / longest edge: 0.943 for the regular tetrahedron, -1
// where it is flat or not positive. Above an aspect of 4 the edges count by their root, so that a slender triangle of
// the boundary, which nothing can help, does not hide flat angles. The sine at an edge is 6 V times the edge over the
// (doubled) areas of its two faces. Without branches, so that loops over many have several at once.
static inline __attribute__((always_inline)) double cw_tet_quality_by(const CwTetMeasures *s) {
  double shortest, longest;
  cw_tet_edges(s, &shortest, &longest);
  const double *l = s->edge, *n = s->area;
  double least = cw_lesser(cw_lesser(l[0] * (n[0] * n[1]), l[1] * (n[0] * n[2])),
                           cw_lesser(l[2] * (n[0] * n[3]), l[3] * (n[1] * n[2])));
  least = s->six * s->six * cw_lesser(least, cw_lesser(l[4] * (n[1] * n[3]), l[5] * (n[2] * n[3])));
  double aspect = CW_TET_ASPECT * shortest / longest;
  double counted = aspect < CW_TET_SLENDER ? sqrt(CW_TET_SLENDER * aspect) : aspect;
  double quality = sqrt(cw_lesser(least / (n[0] * n[1] * n[2] * n[3]), counted));
  return (s->six > 0.0) & (s->six * s->six > CW_TET_FLAT * longest * longest * longest) ? quality : -1.0;
}

static inline double cw_tet_quality(const double a[3], const double b[3], const double c[3], const double d[3]) {
  if (!(cw_tet_volume6(a, b, c, d) > 0.0)) return -1.0; // many are, and need nothing else
  CwTetMeasures s = cw_tet_measures(a, b, c, d);
  return cw_tet_quality_by(&s);
}
