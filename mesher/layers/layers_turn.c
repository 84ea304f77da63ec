// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers_turn.h"

#include <math.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"

static const double MUCH = 100; // more than any quality

double cw_layers_prism_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  const int32_t *v = work->in->triangle[f];
  const double(*x)[3] = work->in->x;
  const double *const wall[3] = {x[v[0]], x[v[1]], x[v[2]]}, *const end[3] = {top[v[0]], top[v[1]], top[v[2]]};
  return cw_prism_quality(wall, end);
}

double cw_layers_top_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  const int32_t *v = work->in->triangle[f];
  const double(*x)[3] = work->in->x;
  const double *const wall[3] = {x[v[0]], x[v[1]], x[v[2]]}, *const end[3] = {top[v[0]], top[v[1]], top[v[2]]};
  return cw_policy.turn_top * cw_prism_top_quality(wall, end);
}

double cw_layers_shear_quality(const CwLayerWork *work, int32_t f, const double (*top)[3], double prism) {
  const int32_t *v = work->in->triangle[f];
  const double(*x)[3] = work->in->x;
  const double *const wall[3] = {x[v[0]], x[v[1]], x[v[2]]}, *const end[3] = {top[v[0]], top[v[1]], top[v[2]]};
  const CwLayerDivision *division = &work->in->division;
  if (division->count < 1 || prism > cw_policy.turn_upright) return cw_policy.prism_good;
  double last[3], normal[3], column[3];
  cw_normal(wall[0], wall[1], wall[2], normal);
  cw_unit(normal);
  for (int k = 0; k < 3; k++) {
    cw_sub(wall[k], end[k], column);
    last[k] =
        division->last ? division->last(division->context, v[k], fabs(cw_dot(column, normal))) : 1.0 / division->count;
  }
  return cw_policy.prism_good * cw_prism_shear_quality(wall, end, division->count, last);
}

double cw_layers_around(const CwLayerWork *work, int32_t v, const double (*top)[3], double floor, int32_t *first) {
  double prism = INFINITY, end = INFINITY, quality = INFINITY;
  int32_t start = work->face_start[v], count = work->face_start[v + 1] - start, worst = *first;
  for (int32_t i = 0; i < count && quality > floor; i++) {
    int32_t at = (*first + i) % count, f = work->face[start + at];
    double q = cw_layers_prism_quality(work, f, top), before = quality;
    if (q < prism) prism = q;
    if (prism < cw_policy.prism_good) {
      quality = prism - MUCH;
    } else {
      double shear = cw_layers_shear_quality(work, f, top, q);
      q = cw_layers_top_quality(work, f, top);
      if (shear < cw_policy.prism_good) q = fmin(q, shear);
      if (q < end) end = q;
      quality = end < prism ? end : prism;
    }
    if (quality < before) worst = at;
  }
  *first = worst;
  return quality;
}

void cw_layers_turn(CwLayerWork *work, int32_t v, double (*top)[3], CwLayerJudge judge) {
  const CwLayerInput *in = work->in;
  const double step[2] = {0.25, 0.1};
  int constraints = in->constraint_count ? in->constraint_count[v] : 0;
  if (constraints == 2) return;
  int32_t first = 0;
  double best = judge(work, v, (const double(*)[3])top, -INFINITY, &first), kept[3], column[3];
  double least_cosine = fmin(cw_policy.column_least_cosine, 0.9 * work->base_cos[v]);
  memcpy(kept, top[v], sizeof kept);
  memcpy(column, work->column[v], sizeof column);
  for (int s = 0; s < 2; s++) {
    double g[3] = {column[0], column[1], column[2]}, side[3], up[3];
    cw_unit(g);
    if (constraints == 1) {
      cw_cross(g, in->constraint_normal[v][0], side);
      memset(up, 0, sizeof up);
    } else {
      int axis = fabs(g[0]) < 0.6 ? 0 : 1;
      double e[3] = {0};
      e[axis] = 1;
      cw_cross(g, e, side);
    }
    cw_unit(side);
    if (constraints == 0) cw_cross(g, side, up);
    double slope = tan(step[s]);
    for (int i = 0; i < 8; i++) {
      if (constraints == 1 && i % 4) continue;
      double angle = i * M_PI / 4, c = cos(angle), d = sin(angle), trial[3];
      for (int k = 0; k < 3; k++) trial[k] = g[k] + slope * (c * side[k] + d * up[k]);
      cw_unit(trial);
      double cosine = cw_layers_least_cosine(work, v, trial);
      if (cosine < least_cosine) continue;
      for (int k = 0; k < 3; k++) work->column[v][k] = trial[k] / fmax(cosine, cw_policy.column_least_cosine);
      cw_layers_place(work, v, top[v]);
      double quality = judge(work, v, (const double(*)[3])top, best, &first);
      if (quality > best) {
        best = quality;
        memcpy(kept, top[v], sizeof kept);
        memcpy(column, work->column[v], sizeof column);
      }
    }
  }
  memcpy(top[v], kept, sizeof kept);
  memcpy(work->column[v], column, sizeof column);
}
