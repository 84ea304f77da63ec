// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_delaunay.h"

#include <math.h>

// Negative where the angles opposite to edge i of t add to more than 180 degrees: sin(a + d) with lengths.
static double angle_margin(const CwPatchWork *work, int32_t t, int i, int on_chords) {
  int32_t n = work->neighbour[t][i];
  int32_t a = work->corner[t][i], b = work->corner[t][(i + 1) % 3], c = work->corner[t][(i + 2) % 3];
  int32_t d = work->corner[n][cw_patch_edge_from(work, n, c, b)];
  double sin_a, sin_d, cos_a, cos_d;
  if (on_chords) {
    const double *xa = work->x[a], *xb = work->x[b], *xc = work->x[c], *xd = work->x[d];
    double ab2 = cw_patch_distance2(xa, xb), ac2 = cw_patch_distance2(xa, xc), bc2 = cw_patch_distance2(xb, xc);
    double db2 = cw_patch_distance2(xd, xb), dc2 = cw_patch_distance2(xd, xc);
    cos_a = 0.5 * (ab2 + ac2 - bc2);
    cos_d = 0.5 * (db2 + dc2 - bc2);
    sin_a = sqrt(fmax(ab2 * ac2 - cos_a * cos_a, 0));
    sin_d = sqrt(fmax(db2 * dc2 - cos_d * cos_d, 0));
  } else {
    double m[3];
    for (int k = 0; k < 3; k++)
      m[k] = 0.25 * (work->metric[a][k] + work->metric[b][k] + work->metric[c][k] + work->metric[d][k]);
    double root = sqrt(fmax(m[0] * m[2] - m[1] * m[1], 0));
    double bu = work->uv[b][0] - work->uv[a][0], bv = work->uv[b][1] - work->uv[a][1];
    double cu = work->uv[c][0] - work->uv[a][0], cv = work->uv[c][1] - work->uv[a][1];
    sin_a = root * (bu * cv - bv * cu);
    cos_a = m[0] * bu * cu + m[1] * (bu * cv + bv * cu) + m[2] * bv * cv;
    bu = work->uv[b][0] - work->uv[d][0], bv = work->uv[b][1] - work->uv[d][1];
    cu = work->uv[c][0] - work->uv[d][0], cv = work->uv[c][1] - work->uv[d][1];
    sin_d = root * (cu * bv - cv * bu);
    cos_d = m[0] * bu * cu + m[1] * (bu * cv + bv * cu) + m[2] * bv * cv;
  }
  double scale = sqrt((sin_a * sin_a + cos_a * cos_a) * (sin_d * sin_d + cos_d * cos_d));
  return scale > 0 ? (sin_a * cos_d + sin_d * cos_a) / scale : 0;
}

// Whether the flip of edge i of t would fold the surface in space.
static int flip_folds(const CwPatchWork *work, int32_t t, int i) {
  int32_t n = work->neighbour[t][i];
  int32_t a = work->corner[t][i], b = work->corner[t][(i + 1) % 3], c = work->corner[t][(i + 2) % 3];
  int32_t d = work->corner[n][cw_patch_edge_from(work, n, c, b)];
  double now = fmin(cw_patch_quality(work, a, b, c), cw_patch_quality(work, d, c, b));
  double then = fmin(cw_patch_quality(work, a, b, d), cw_patch_quality(work, a, d, c));
  return then <= 0 && then <= now;
}

int64_t cw_patch_delaunay(CwPatchWork *work, int on_chords) {
  int64_t all = 0, flips = 1;
  // In a metric that changes from place to place flips may chase each other, hence the bound.
  for (int pass = 0; pass < 40 && flips; pass++) {
    flips = 0;
    for (int32_t t = 0; t < work->triangle_count; t++) {
      if (work->corner[t][0] < 0) continue;
      for (int i = 0; i < 3; i++)
        if (!(work->given[t] >> i & 1) && (pass > 0 || work->neighbour[t][i] > t) &&
            angle_margin(work, t, i, on_chords) < -1e-6 && !(on_chords && flip_folds(work, t, i)))
          flips += cw_patch_flip(work, t, i);
    }
    all += flips;
  }
  return all;
}
