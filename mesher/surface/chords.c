// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/chords.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/vec.h"

// Of the square of a chord: twice the area under which a point lies on it. Rounding of (u,v) that was found by
// projection.
static const double ON_CHORD = 1e-7;

typedef struct {
  double low[2], high[2];
  int32_t chord;
} Lens;

static int compare_lenses(const void *p, const void *q) {
  const Lens *a = p, *b = q;
  if (a->low[0] != b->low[0]) return a->low[0] < b->low[0] ? -1 : 1;
  return (a->chord > b->chord) - (a->chord < b->chord);
}

static Lens lens_of(const CwChord *chord, int32_t number) {
  Lens lens = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, number};
  for (int i = 0; i < CW_CHORD_SAMPLES; i++) {
    for (int k = 0; k < 2; k++) {
      lens.low[k] = fmin(lens.low[k], chord->uv[i][k]);
      lens.high[k] = fmax(lens.high[k], chord->uv[i][k]);
    }
  }
  return lens;
}

static int on_chord(const double a[2], const double b[2], const double p[2]) {
  double d[2] = {b[0] - a[0], b[1] - a[1]}, square = d[0] * d[0] + d[1] * d[1];
  double along = (p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1];
  return along > 0 && along < square && fabs(cw_twice_area(a, b, p)) < ON_CHORD * square;
}

// By the parity of a ray.
static int in_lens(const CwChord *chord, const double p[2]) {
  int inside = 0;
  for (int i = 0, j = CW_CHORD_SAMPLES - 1; i < CW_CHORD_SAMPLES; j = i++) {
    const double *a = chord->uv[j], *b = chord->uv[i];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    inside ^= p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
  }
  return inside;
}

static int holds_end(const CwChord *chord, const CwChord *other) {
  for (int k = 0; k < 2; k++) {
    const double *p = other->uv[k ? CW_CHORD_SAMPLES - 1 : 0];
    if (other->point[k] == chord->point[0] || other->point[k] == chord->point[1]) continue;
    if (on_chord(chord->uv[0], chord->uv[CW_CHORD_SAMPLES - 1], p) || in_lens(chord, p)) return 1;
  }
  return 0;
}

static int cross_or_coincide(const CwChord *a, const CwChord *b) {
  int common = 0;
  for (int k = 0; k < 2; k++) common += a->point[k] == b->point[0] || a->point[k] == b->point[1];
  if (common) return common == 2;
  const double *a0 = a->uv[0], *a1 = a->uv[CW_CHORD_SAMPLES - 1], *b0 = b->uv[0], *b1 = b->uv[CW_CHORD_SAMPLES - 1];
  return (cw_twice_area(a0, a1, b0) > 0) != (cw_twice_area(a0, a1, b1) > 0) &&
         (cw_twice_area(b0, b1, a0) > 0) != (cw_twice_area(b0, b1, a1) > 0);
}

static void judge_pair(const CwChord *chord, int32_t i, int32_t j, uint8_t *halve) {
  const CwChord *a = &chord[i], *b = &chord[j];
  int in_a = !a->given && holds_end(a, b), in_b = !b->given && holds_end(b, a);
  halve[i] |= (uint8_t)in_a;
  halve[j] |= (uint8_t)in_b;
  if (in_a || in_b || (a->given && b->given) || !cross_or_coincide(a, b)) return;
  int first = b->given || (!a->given && (a->deviation > b->deviation || (a->deviation == b->deviation && i < j)));
  halve[first ? i : j] = 1;
}

CwStatus cw_chords_to_halve(int32_t count, const CwChord *chord, uint8_t *halve) {
  CwStatus status = CW_OK;
  Lens *lens = NULL;
  CW_NEW(lens, count);
  for (int32_t i = 0; i < count; i++) {
    halve[i] = 0;
    lens[i] = lens_of(&chord[i], i);
  }
  qsort(lens, (size_t)count, sizeof *lens, compare_lenses);
  for (int32_t i = 0; i < count; i++) {
    for (int32_t j = i + 1; j < count && lens[j].low[0] <= lens[i].high[0]; j++) {
      if (lens[j].low[1] > lens[i].high[1] || lens[j].high[1] < lens[i].low[1]) continue;
      judge_pair(chord, lens[i].chord, lens[j].chord, halve);
    }
  }
done:
  free(lens);
  return status;
}
