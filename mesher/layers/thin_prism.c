// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/thin_prism.h"

#include <math.h>

double cw_thin_prism_wanted(double determinant) {
  return pow(CW_SMALL_DETERMINANT / determinant, 0.25);
}

double cw_prism_determinant(const double base[3][3], const double top[3][3], int on_wall) {
  const double *x[6] = {base[0], base[1], base[2], top[0], top[1], top[2]};
  const unsigned sides_and_top = 1 << 0 | 1 << 1 | 1 << 2 | 1 << 4, base_too = 1 << 3;
  return cw_cell_determinant(6, x, on_wall ? sides_and_top : sides_and_top | base_too);
}
