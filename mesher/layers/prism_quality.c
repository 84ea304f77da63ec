// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/prism_quality.h"

#include "mesher/common/vec.h"
#include "mesher/layers/thin_prism.h"
#include "pipeline/mesh/cell.h"

static const double ENOUGH = 1.05 * CW_SMALL_DETERMINANT;
static const double SIDE_ENOUGH = 0.1; // of half of the pyramid on a side, over the mean of its halves

double cw_prism_quality(const double *const wall[3], const double *const top[3]) {
  double least = INFINITY, d[3][3], e[3][3], de[3][3], sine[3], height[3], length[3];
  for (int i = 0; i < 3; i++) {
    cw_sub(top[i], wall[i], d[i]);
    height[i] = cw_norm(d[i]);
  }
  for (int i = 0; i < 3; i++) {
    cw_sub(wall[(i + 1) % 3], wall[i], e[i]); // edge from corner i to the next
    cw_sub(d[(i + 1) % 3], d[i], de[i]);      // how it changes from wall to layer top
    length[i] = cw_norm(e[i]);
  }
  for (int i = 0; i < 3; i++) {
    double c[3];
    int last = (i + 2) % 3;
    if (height[i] == 0) continue; // no corner of a tapered prism
    cw_cross(e[last], e[i], c);
    sine[i] = cw_norm(c) / (length[i] * length[last]);
  }
  for (int level = 0; level <= 4; level++) {
    double edge[3][3];
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) edge[i][k] = e[i][k] + 0.25 * level * de[i][k];
      if (level > 0) length[i] = cw_norm(edge[i]);
    }
    for (int i = 0; i < 3; i++) {
      int last = (i + 2) % 3;
      if (height[i] == 0) continue;
      double c[3], scale = length[i] * length[last] * height[i] * sine[i];
      cw_cross(edge[i], edge[last], c); // with the minus of edge[last]: into the fluid
      double q = scale > 0 ? cw_dot(c, d[i]) / scale : -1;
      if (q < least) least = q;
    }
  }
  return least;
}

double cw_prism_top_quality(const double *const wall[3], const double *const top[3]) {
  const double *const *const x[2] = {wall, top};
  double least = INFINITY;
  for (int i = 0; i < 3; i++) {
    double c[2][3], scale[2];
    for (int k = 0; k < 2; k++) {
      double next[3], last[3];
      cw_sub(x[k][(i + 1) % 3], x[k][i], next);
      cw_sub(x[k][(i + 2) % 3], x[k][i], last);
      cw_cross(next, last, c[k]);
      scale[k] = cw_norm(next) * cw_norm(last);
    }
    double q = scale[1] > 0 ? cw_dot(c[0], c[1]) / cw_dot(c[0], c[0]) * scale[0] / scale[1] : -1;
    if (q < least) least = q;
  }
  return least;
}

// Determinant of the right prism with the base's triangle and as high as the top is over it, in the mean.
static double right_determinant(const double base[3][3], const double upper[3][3], int on_wall) {
  double column[3], normal[3], height = 0, right[3][3];
  cw_normal(base[0], base[1], base[2], normal);
  cw_unit(normal);
  for (int k = 0; k < 3; k++) {
    cw_sub(upper[k], base[k], column);
    height += cw_dot(column, normal) / 3;
  }
  for (int k = 0; k < 9; k++) right[k / 3][k % 3] = base[k / 3][k % 3] + height * normal[k % 3];
  return cw_prism_determinant(base, (const double(*)[3])right, on_wall);
}

// The least half of the pyramids on the sides of a prism, over the mean of its side.
static double sides_quality(const double base[3][3], const double upper[3][3]) {
  double middle[3], least = INFINITY;
  for (int k = 0; k < 3; k++)
    middle[k] = (base[0][k] + base[1][k] + base[2][k] + upper[0][k] + upper[1][k] + upper[2][k]) / 6;
  for (int i = 0; i < 3; i++) {
    const double *const x[4] = {base[i], base[(i + 1) % 3], upper[(i + 1) % 3], upper[i]};
    double half[4];
    cw_quad_halves(x, middle, half);
    double mean = half[0] / 4 + half[1] / 4 + half[2] / 4 + half[3] / 4;
    for (int k = 0; k < 4; k++) least = fmin(least, half[k] / mean);
  }
  return least;
}

double cw_prism_shear_quality(const double *const wall[3], const double *const top[3], int layers,
                              const double last[3]) {
  double least = 1;
  for (int k = 0; k < 3; k++)
    if (cw_distance(wall[k], top[k]) == 0) return least; // tapered
  for (int on_wall = 0; on_wall < 2; on_wall++) {
    double base[3][3], upper[3][3];
    for (int k = 0; k < 3; k++) {
      cw_lerp(wall[k], top[k], on_wall ? 0 : 1 - last[k], base[k]);
      cw_lerp(wall[k], top[k], on_wall ? 1.0 / layers : 1, upper[k]);
    }
    const double(*b)[3] = (const double(*)[3])base, (*t)[3] = (const double(*)[3])upper;
    least = fmin(least, sides_quality(b, t) / SIDE_ENOUGH);
    if (right_determinant(b, t, on_wall) < ENOUGH) continue;
    least = fmin(least, cw_prism_determinant(b, t, on_wall) / ENOUGH);
  }
  return least;
}
