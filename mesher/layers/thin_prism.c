// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/thin_prism.h"

#include <math.h>

#include "mesher/common/vec.h"

double cw_thin_prism_wanted(double determinant) {
  return pow(CW_SMALL_DETERMINANT / determinant, 0.25);
}

// Area vector of the face whose diagonals are ac and bd; of a triangle whose sides they are.
static void add_face(const double a[3], const double c[3], const double b[3], const double d[3], double sum[3][3],
                     double *areas) {
  double ac[3], bd[3], area[3];
  cw_sub(c, a, ac);
  cw_sub(d, b, bd);
  cw_cross(ac, bd, area);
  *areas += 0.5 * cw_norm(area);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) sum[i][j] += 0.25 * area[i] * area[j];
  }
}

double cw_prism_determinant(const double base[3][3], const double top[3][3], int on_wall) {
  double sum[3][3] = {{0}}, areas = 0, cross[3];
  if (!on_wall) add_face(base[0], base[1], base[0], base[2], sum, &areas);
  add_face(top[0], top[1], top[0], top[2], sum, &areas);
  for (int i = 0; i < 3; i++) add_face(base[i], top[(i + 1) % 3], base[(i + 1) % 3], top[i], sum, &areas);
  double mean = areas / (on_wall ? 4 : 5);
  cw_cross(sum[1], sum[2], cross);
  return cw_dot(sum[0], cross) / (8 * pow(mean, 6));
}
