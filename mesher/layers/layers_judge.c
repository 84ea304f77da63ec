// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers_judge.h"

#include <math.h>

#include "mesher/common/vec.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_turn.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"

static const double GAIN = 1e-6; // of quality: less is none

// Of prism f; prism_good at least where it is no worse than its columns have to lean.
static double prism_quality(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  double prism = cw_layers_prism_quality(work, f, top), least = INFINITY;
  for (int k = 0; k < 3; k++) least = fmin(least, work->base_cos[work->in->triangle[f][k]]);
  return prism >= cw_policy.lean_share * least ? fmax(prism, cw_policy.prism_good) : prism;
}

double cw_layers_judge(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  double prism = prism_quality(work, f, top), quality = prism < cw_policy.sound_quality ? prism : cw_policy.prism_good;
  for (int k = 0; k < 3; k++) {
    int32_t v = work->in->triangle[f][k];
    if (work->t[v] <= cw_layer_least(work->in, v)) continue;
    quality = fmin(prism, cw_layers_top_quality(work, f, top));
    break;
  }
  if (quality <= cw_policy.prism_good) return quality;
  return cw_layers_lean_quality(work, f, top) < cw_policy.prism_good ? cw_policy.prism_good : quality;
}

int cw_layers_is_sound(const CwLayerWork *work, int32_t f, const double (*top)[3]) {
  return prism_quality(work, f, top) >= cw_policy.sound_quality;
}

// The quality of prism f if its column k were thinned; k = 3: as it is.
static double thinned_quality(const CwLayerWork *work, int32_t f, const double (*top)[3], int k, int sound) {
  const int32_t *v = work->in->triangle[f];
  const double(*x)[3] = work->in->x;
  double end[3][3];
  for (int c = 0; c < 3; c++) cw_lerp(x[v[c]], top[v[c]], c == k ? cw_policy.column_kept : 1, end[c]);
  const double *const wall[3] = {x[v[0]], x[v[1]], x[v[2]]}, *const ends[3] = {end[0], end[1], end[2]};
  double prism = cw_prism_quality(wall, ends);
  return sound ? fmin(prism, cw_policy.turn_top * cw_prism_top_quality(wall, ends)) : prism;
}

void cw_layers_helped_by(const CwLayerWork *work, int32_t f, const double (*top)[3], int sound, int helps[3]) {
  double before = thinned_quality(work, f, top, 3, sound);
  int any = 0;
  for (int k = 0; k < 3; k++) {
    int32_t v = work->in->triangle[f][k];
    int gives = !sound || work->t[v] > cw_layer_least(work->in, v);
    helps[k] = gives && thinned_quality(work, f, top, k, sound) > before + GAIN;
    any |= helps[k];
  }
  for (int k = 0; k < 3 && !any; k++) helps[k] = 1;
}
