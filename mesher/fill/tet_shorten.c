// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_work.h"

#include <math.h>
#include <string.h>

static const double usual = 1.4;         // what neither helps nor hinders, so that their number does not count
static const double gain = 1e-3;         // at least, in the sum
static const double least_quality = 0.3; // of what comes, or as it was before
enum { RING = 4 }; // tetrahedra round an edge, at most: of removals with five one in fifteen would help

static inline double square_of(const CwTetWork *w, int32_t p, int32_t q) {
  const double *x = cw_tet_at(w, p), *y = cw_tet_at(w, q);
  double u = y[0] - x[0], v = y[1] - x[1], z = y[2] - x[2];
  return u * u + v * v + z * z;
}

// Longest over shortest edge, less the usual.
static double excess_of(const CwTetWork *w, const int32_t c[4]) {
  double shortest = INFINITY, longest = 0.0;
  for (int e = 0; e < 6; e++) {
    double square = square_of(w, c[cw_tet_edge[e][0]], c[cw_tet_edge[e][1]]);
    shortest = cw_tet_less(shortest, square);
    longest = cw_tet_more(longest, square);
  }
  return sqrt(longest / shortest) - usual;
}

// Asks the memory for the neighbours of one that comes a little later in the list, and for one that comes later still.
static inline void ask_ahead(const CwTetWork *w, int32_t k) {
  const CwTetList *list = &w->slender;
  const CwDelaunayTet *tet = w->mesh->tet;
  if (k + 16 < list->count) __builtin_prefetch(&tet[list->tet[k + 16]], 1);
  if (k + 8 < list->count) {
    for (int i = 0; i < 4; i++) {
      int32_t next = tet[list->tet[k + 8]].neighbour[i];
      if (next >= 0) __builtin_prefetch(&tet[next / 4], 1);
    }
  }
}

// Removes the edge a-b of t, whose square is given.
static CwStatus remove_edge(CwTetWork *w, int32_t t, int32_t a, int32_t b, double square) {
  CwStatus status = CW_OK;
  int32_t old[CW_RING], ring[CW_RING], made[RING][4];
  double before = 0.0, after = 0.0, quality[RING], least = least_quality;
  int n = cw_flips_ring(&w->flips, t, a, b, RING, old, ring), count = n == 3 ? 2 : 4, first = 0;
  if (n < 3) goto done;
  if (n == 4) { // the shorter one of the two edges that may come
    double one = square_of(w, ring[0], ring[2]), other = square_of(w, ring[1], ring[3]);
    if (one >= square && other >= square) goto done;
    first = other < one;
  }
  for (int k = 0; k < n; k++) {
    before += excess_of(w, w->mesh->tet[old[k]].corner);
    least = cw_tet_less(least, w->mesh->tet[old[k]].square);
  }
  for (int k = 0; k < count; k++) {
    int32_t p = ring[first], q = ring[first + 1 + k / 2], r = ring[(first + 2 + k / 2) % n];
    memcpy(made[k], k % 2 ? (int32_t[4]){p, r, q, a} : (int32_t[4]){p, q, r, b}, sizeof *made);
    after += excess_of(w, made[k]);
  }
  if (!(after < before - gain)) goto done;
  for (int k = 0; k < count; k++) {
    quality[k] = cw_tet_quality_of(w, made[k][0], made[k][1], made[k][2], made[k][3]);
    if (!(quality[k] > 0.0 && quality[k] >= least)) goto done;
  }
  CW_TRY(cw_tet_replace(w, n, old, count, (const int32_t(*)[4])made, quality));
  w->count.edges_removed++;
done:
  return status;
}

CwStatus cw_tet_shorten(CwTetWork *w) {
  CwStatus status = CW_OK;
  for (int32_t k = 0; k < w->slender.count; k++) {
    int32_t t = w->slender.tet[k];
    ask_ahead(w, k);
    const int32_t *c = w->mesh->tet[t].corner;
    if (c[0] < 0) continue;
    double square, shortest = INFINITY, longest = 0.0;
    int32_t a = -1, b = -1;
    for (int e = 0; e < 6; e++) {
      int32_t p = c[cw_tet_edge[e][0]], q = c[cw_tet_edge[e][1]];
      square = square_of(w, p, q);
      shortest = cw_tet_less(shortest, square);
      if (square > longest) longest = square, a = p, b = q;
    }
    if (!(longest > CW_TET_LONG * CW_TET_LONG * shortest)) continue;
    CW_TRY(remove_edge(w, t, a, b, longest));
  }
done:
  return status;
}
