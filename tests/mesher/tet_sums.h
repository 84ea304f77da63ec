// SPDX-License-Identifier: AGPL-3.0-or-later
// The shape of a mesh of tetrahedra before and after they are improved, and what their list keeps of them.
#pragma once

#include <math.h>

#include "mesher/fill/tet_aspect.h"
#include "tests/unit_test.h"

typedef struct {
  int count;
  double six;                    // times the volume, of all
  double aspect, quality, least; // mean ratio of the longest to the shortest edge, mean and least quality
} TetSums;

// Of the tetrahedra with a source of `first` or more (but `six`); all must be positive.
static inline TetSums tet_sums(const CwTetWork *w, int32_t first) {
  TetSums sums = {.least = 1.0};
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    const int32_t *c = w->mesh->tet[t].corner;
    int counts = 0;
    if (c[0] < 0) continue;
    for (int i = 0; i < 4; i++) counts |= w->mesh->source[c[i]] >= first;
    CwTetMeasures m = cw_tet_measures(cw_tet_at(w, c[0]), cw_tet_at(w, c[1]), cw_tet_at(w, c[2]), cw_tet_at(w, c[3]));
    double shortest, longest, quality = cw_tet_quality_of(w, c[0], c[1], c[2], c[3]);
    assert_true(m.six > 0.0);
    sums.six += m.six;
    if (!counts) continue;
    cw_tet_edges(&m, &shortest, &longest);
    sums.aspect += sqrt(longest / shortest);
    sums.quality += quality;
    sums.least = fmin(sums.least, quality);
    sums.count++;
  }
  sums.aspect /= sums.count;
  sums.quality /= sums.count;
  return sums;
}

// Qualities are kept with the tetrahedra, and those below the limit listed.
static inline void assert_qualities_kept(const CwTetWork *w) {
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    const CwTet *tet = &w->mesh->tet[t];
    const int32_t *c = tet->corner;
    if (c[0] < 0) continue;
    double quality = cw_tet_quality_of(w, c[0], c[1], c[2], c[3]);
    assert_true(tet->quality == 1.0 || fabs(tet->quality - quality) < (quality < w->limit ? 1e-15 : 1e-5));
    int listed = tet->quality >= w->limit;
    for (int32_t k = 0; k < w->next.count && !listed; k++) listed = w->next.tet[k] == t;
    assert_true(listed);
  }
}
