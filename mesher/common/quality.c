// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/quality.h"

#include <float.h>
#include <math.h>

#include "mesher/common/tet.h"
#include "mesher/common/vec.h"

double cw_tet_volume6_error(const double a[3], const double b[3], const double c[3], const double d[3]) {
  double u[3], v[3], w[3], permanent = 0.0;
  cw_sub(b, a, u);
  cw_sub(c, a, v);
  cw_sub(d, a, w);
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    permanent += (fabs(u[j] * v[k]) + fabs(u[k] * v[j])) * fabs(w[i]);
  }
  // Shewchuk's bound of the plain determinant is (7 + 56 eps) eps with eps = 2^-53.
  return 4.0 * DBL_EPSILON * permanent;
}

void cw_tet_shape(const double *const x[4], CwTetShape *shape) {
  double normal[4][3], longest = 0.0, shortest = INFINITY, squares = 0.0;
  for (int i = 0; i < 4; i++) {
    double u[3], v[3];
    cw_sub(x[cw_tet_face[i][1]], x[cw_tet_face[i][0]], u);
    cw_sub(x[cw_tet_face[i][2]], x[cw_tet_face[i][0]], v);
    cw_cross(u, v, normal[i]);
    double inverse = 1.0 / sqrt(cw_dot(normal[i], normal[i]));
    for (int k = 0; k < 3; k++) normal[i][k] *= inverse;
    for (int j = i + 1; j < 4; j++) {
      cw_sub(x[j], x[i], u);
      double length = cw_dot(u, u);
      squares += length;
      longest = cw_greater(longest, length);
      shortest = cw_lesser(shortest, length);
    }
  }
  shape->volume = cw_tet_volume6(x[0], x[1], x[2], x[3]) / 6.0;
  double root = cbrt(3.0 * cw_greater(shape->volume, 0.0));
  shape->mean_ratio = squares > 0.0 ? 12.0 * root * root / squares : 0.0;
  shape->edge_longest = sqrt(longest);
  shape->edge_shortest = sqrt(shortest);
  double most = -1.0, least = 1.0; // cosines
  for (int i = 0; i < 4; i++) {
    for (int j = i + 1; j < 4; j++) {
      double cosine = -cw_dot(normal[i], normal[j]);
      most = cw_greater(most, cosine); // a face without area has none, and leaves both as they are
      least = cw_lesser(cosine, least);
    }
  }
  const double degrees = 180.0 / M_PI;
  int flat = !(shape->volume > 0.0);
  shape->dihedral_least = flat ? 0.0 : acos(cw_lesser(most, 1.0)) * degrees;
  shape->dihedral_greatest = flat ? 180.0 : acos(cw_greater(least, -1.0)) * degrees;
}

double cw_prism_scaled_jacobian(const double *const x[6]) {
  double least = INFINITY;
  for (int corner = 0; corner < 6; corner++) {
    int top = corner / 3, at = corner % 3;
    double u[3], v[3], w[3], n[3];
    cw_sub(x[3 * top + (at + 1) % 3], x[corner], u);
    cw_sub(x[3 * top + (at + 2) % 3], x[corner], v);
    cw_sub(x[at + 3], x[at], w);
    cw_cross(u, v, n);
    double scale = sqrt(cw_dot(u, u) * cw_dot(v, v) * cw_dot(w, w));
    double jacobian = scale > 0.0 ? cw_dot(n, w) / scale : 0.0;
    least = fmin(least, jacobian);
  }
  return least * 2.0 / sqrt(3.0); // sin 60 degrees is the best corner
}
