// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_work.h"

#include <stdlib.h>

static const double loss = 1.0; // at most, in the sum
enum { CROWDED = 7 };           // slender tetrahedra at their shortest edges with a point that is tried

// The shortest edges of slender tetrahedra at a point.
typedef struct {
  int32_t count, tet, to; // how many tetrahedra; one with the shortest of them, and its other end
  double square;
} Crowd;

static inline void note(Crowd *crowd, int32_t t, int32_t to, double square) {
  if (crowd->count++ && crowd->square <= square) return;
  crowd->tet = t, crowd->to = to, crowd->square = square;
}

// Whether earlier changes have left the edge.
static int has_edge(const CwTetWork *w, int32_t t, int32_t p, int32_t q) {
  const int32_t *c = w->mesh->tet[t].corner;
  int ends = 0;
  for (int i = 0; i < 4; i++) ends += c[i] == p || c[i] == q;
  return c[0] >= 0 && ends == 2;
}

// The inner point p of t goes into q.
static CwStatus collapse(CwTetWork *w, int32_t t, int32_t p, int32_t q) {
  CwStatus status = CW_OK;
  int32_t star[CW_TET_STAR], made[CW_FLIP][4];
  double sum = 0.0, least = w->floor;
  int count = 0, n = cw_tet_star(w, t, p, star);
  if (n == 0 || n > CW_FLIP) goto done;
  for (int k = 0; k < n; k++) {
    const CwDelaunayTet *tet = &w->mesh->tet[star[k]];
    int vanishes = 0;
    sum -= cw_tet_excess(w, tet->corner);
    least = cw_tet_less(least, tet->quality);
    for (int i = 0; i < 4; i++) {
      made[count][i] = tet->corner[i] == p ? q : tet->corner[i];
      vanishes |= tet->corner[i] == q;
    }
    count += !vanishes;
  }
  for (int k = 0; k < count; k++) sum += cw_tet_excess(w, (const int32_t *)made[k]);
  if (!(sum < loss)) goto done;
  CW_TRY(cw_tet_replace_sound(w, n, star, count, (const int32_t(*)[4])made, least, &w->count.points_removed));
done:
  return status;
}

CwStatus cw_tet_collapse(CwTetWork *w) {
  CwStatus status = CW_OK;
  Crowd *crowd = NULL;
  CW_NEW(crowd, w->mesh->point_count);
  for (int32_t k = 0; k < w->slender.count; k++) {
    int32_t t = w->slender.tet[k];
    const int32_t *c = w->mesh->tet[t].corner;
    cw_tet_ask_ahead(w, w->slender.tet, w->slender.count, k);
    if (c[0] < 0) continue;
    CwTetEnds ends = cw_tet_ends(w, c);
    if (!cw_tet_is_slender(w, &ends)) continue;
    for (int i = 0; i < 2; i++) note(&crowd[ends.near[i]], t, ends.near[1 - i], ends.shortest);
  }
  for (int32_t p = 0; p < w->mesh->point_count; p++) {
    if (crowd[p].count < CROWDED || w->mesh->source[p] < w->fixed_count) continue;
    if (has_edge(w, crowd[p].tet, p, crowd[p].to)) CW_TRY(collapse(w, crowd[p].tet, p, crowd[p].to));
  }
done:
  free(crowd);
  return status;
}
