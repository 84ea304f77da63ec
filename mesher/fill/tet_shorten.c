// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_shorten.h"

#include <math.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/fill/tet_aspect.h"

enum { RING = 4 }; // tetrahedra round an edge, at most: of removals with five one in fifteen would help

// Removes the edge a-b of t.
static CwStatus remove_edge(CwTetWork *w, double floor, int32_t t, int32_t a, int32_t b) {
  CwStatus status = CW_OK;
  int32_t old[RING], ring[RING], made[RING][4];
  double before = 0.0, after = 0.0, least = floor;
  int n = cw_tet_ring(w->mesh, t, a, b, RING, old, ring), count = n == 3 ? 2 : 4, first = 0;
  if (n < 3) goto done;
  if (n == 4) { // the shorter one of the two edges that may come
    double one = cw_tet_square_of(w, ring[0], ring[2]), other = cw_tet_square_of(w, ring[1], ring[3]);
    first = other < one;
  }
  for (int k = 0; k < n; k++) {
    before += cw_tet_excess(w, w->mesh->tet[old[k]].corner);
    least = cw_lesser(least, w->mesh->tet[old[k]].quality);
  }
  for (int k = 0; k < count; k++) {
    int32_t p = ring[first], q = ring[first + 1 + k / 2], r = ring[(first + 2 + k / 2) % n];
    memcpy(made[k], k % 2 ? (int32_t[4]){p, r, q, a} : (int32_t[4]){p, q, r, b}, sizeof *made);
    after += cw_tet_excess(w, made[k]);
  }
  if (!(after < before)) goto done;
  CW_TRY(cw_tet_replace_sound(w, n, old, count, (const int32_t(*)[4])made, least, &w->count.edges_removed));
done:
  return status;
}

// Prefetches the corners of one that comes a little later in the list.
static inline __attribute__((always_inline)) void prefetch_corners(const CwTetWork *w, const CwTetList *list,
                                                                   int32_t k) {
  if (k + 8 >= list->count) return;
  const int32_t *later = w->mesh->tet[list->tet[k + 8]].corner;
  for (int i = 0; i < 4 && later[0] >= 0; i++) __builtin_prefetch(cw_tet_at(w, later[i]));
}

CwStatus cw_tet_shorten(CwTetWork *w, const CwTetShapes *shapes) {
  CwStatus status = CW_OK;
  const double slender_square = cw_tet_slender_square();
  for (int32_t k = 0; k < shapes->slender.count; k++) {
    int32_t t = shapes->slender.tet[k];
    cw_tet_prefetch_list(w, shapes->slender.tet, shapes->slender.count, k);
    prefetch_corners(w, &shapes->slender, k);
    const int32_t *c = w->mesh->tet[t].corner;
    if (c[0] < 0) continue;
    CwTetEnds ends = cw_tet_ends(w, c);
    if (ends.longest > slender_square * ends.shortest && cw_tet_ring_is_short(w->mesh, t, ends.far[0], ends.far[1]))
      CW_TRY(remove_edge(w, shapes->floor, t, ends.far[0], ends.far[1]));
  }
done:
  return status;
}
