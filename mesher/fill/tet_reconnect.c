// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_reconnect.h"

#include <math.h>
#include <string.h>

#include "mesher/common/ring.h"
#include "mesher/common/tet.h"

// Least improvement, so that rounding undoes no change for ever.
static const double least_gain = 1e-6;
enum { RING = 8 };

// Triangulations of the ring by dynamic programming (Klincsek): best[i][j] is the best least quality over the
// part i..j.
typedef struct {
  double best[RING][RING];
  int8_t cut[RING][RING];
} RingTable;

CwStatus cw_tet_remove_edge(CwTetWork *w, int32_t t, int32_t a, int32_t b, int *done_it) {
  CwStatus status = CW_OK;
  int32_t old[RING], ring[RING], tet[2 * RING][4];
  double quality[2 * RING], least = INFINITY;
  RingTable table;
  *done_it = 0;
  int n = cw_tet_ring(w->mesh, t, a, b, RING, old, ring);
  if (n < 3) goto done;
  for (int k = 0; k < n; k++) {
    double q = w->mesh->tet[old[k]].quality;
    if (q < least) least = q;
    if (k + 1 < n) table.best[k][k + 1] = INFINITY;
  }
  least += least_gain;
  for (int span = 2; span < n; span++) {
    for (int from = 0; from + span < n; from++) {
      int to = from + span;
      double best = -INFINITY;
      table.cut[from][to] = (int8_t)(from + 1);
      for (int k = from + 1; k < to; k++) {
        double worst = table.best[from][k] < table.best[k][to] ? table.best[from][k] : table.best[k][to];
        if (worst <= least || worst <= best) continue;
        double q = cw_tet_quality_of(w, ring[from], ring[k], ring[to], b);
        if (q < worst) worst = q;
        if (worst <= least || worst <= best) continue;
        q = cw_tet_quality_of(w, ring[from], ring[to], ring[k], a);
        if (q < worst) worst = q;
        if (worst <= best) continue;
        best = worst;
        table.cut[from][to] = (int8_t)k;
      }
      table.best[from][to] = best;
    }
  }
  if (!(table.best[0][n - 1] > least)) goto done;
  int count = cw_ring_tets(&table.cut[0][0], RING, ring, a, b, 0, n - 1, tet, 0);
  for (int k = 0; k < count; k++) quality[k] = cw_tet_quality_of(w, tet[k][0], tet[k][1], tet[k][2], tet[k][3]);
  CW_TRY(cw_tet_replace(w, n, old, count, (const int32_t(*)[4])tet, quality));
  w->count.edges_removed++;
  *done_it = 1;
done:
  return status;
}

CwStatus cw_tet_remove_face(CwTetWork *w, int32_t t, int i, int *done_it) {
  CwStatus status = CW_OK;
  const CwTet *tet = &w->mesh->tet[t];
  int32_t made[3][4], other = tet->neighbour[i];
  double quality[3];
  *done_it = 0;
  if (other < 0) goto done;
  const int32_t old[2] = {t, other / 4};
  int32_t below = tet->corner[i], above = w->mesh->tet[old[1]].corner[other % 4];
  double least = w->mesh->tet[old[1]].quality < tet->quality ? w->mesh->tet[old[1]].quality : tet->quality;
  for (int k = 0; k < 3; k++) {
    const int32_t one[4] = {tet->corner[cw_tet_face[i][k]], tet->corner[cw_tet_face[i][(k + 1) % 3]], below, above};
    quality[k] = cw_tet_quality_of(w, one[0], one[1], one[2], one[3]);
    if (quality[k] <= least + least_gain) goto done;
    memcpy(made[k], one, sizeof one);
  }
  CW_TRY(cw_tet_replace(w, 2, old, 3, (const int32_t(*)[4])made, quality));
  w->count.faces_removed++;
  *done_it = 1;
done:
  return status;
}
