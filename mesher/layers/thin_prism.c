// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/thin_prism.h"

#include <math.h>

double cw_thin_prism_determinant(double area, double around, double height, int on_wall) {
  // Along the height the triangles give n A^2. Across it the sides give the sum of (Si x Sj)^2 over their three pairs,
  // 4 A^2 h^4 each, whatever the shape of the triangle.
  int triangles = on_wall ? 1 : 2;
  double mean = (triangles * area + around * height) / (triangles + 3);
  double over = area * height / (mean * mean);
  return 1.5 * triangles * over * over * over * over * mean * mean;
}

double cw_thin_prism_wanted(double determinant) {
  return pow(CW_SMALL_DETERMINANT / determinant, 0.25);
}
