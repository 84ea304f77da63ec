// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_loop.h"

#include <string.h>

#include "mesher/common/tet.h"
#include "mesher/fill/tet_insert.h"
#include "mesher/fill/tet_move.h"
#include "mesher/fill/tet_reconnect.h"

// One try at a tetrahedron: the first change that helps.
static CwStatus improve_one(CwTetWork *w, int32_t t, int move, int insert, int *done_it) {
  CwStatus status = CW_OK;
  int32_t c[4];
  int order[6];
  memcpy(c, w->mesh->tet[t].corner, sizeof c);
  *done_it = 0;
  CwTetMeasures m = cw_tet_measures(cw_tet_at(w, c[0]), cw_tet_at(w, c[1]), cw_tet_at(w, c[2]), cw_tet_at(w, c[3]));
  for (int e = 0; e < 6; e++) { // longest first: the diagonals of a flat one
    int k = e;
    for (; k > 0 && m.edge[order[k - 1]] < m.edge[e]; k--) order[k] = order[k - 1];
    order[k] = e;
  }
  for (int e = 0; e < 6 && !*done_it; e++)
    CW_TRY(cw_tet_remove_edge(w, t, c[cw_tet_edge[order[e]][0]], c[cw_tet_edge[order[e]][1]], done_it));
  for (int i = 0; i < 4 && !*done_it; i++) CW_TRY(cw_tet_remove_face(w, t, i, done_it));
  for (int i = 0; i < 4 && move && !*done_it; i++) CW_TRY(cw_tet_move_point(w, t, c[i], done_it));
  if (insert && !*done_it && w->mesh->tet[t].quality < w->insert) CW_TRY(cw_tet_insert(w, t, done_it));
done:
  return status;
}

CwStatus cw_tet_improve_list(CwTetWork *w, int passes, int move) {
  CwStatus status = CW_OK;
  for (int pass = 0; pass < passes && w->next.count; pass++) {
    CwTetList swap = w->bad;
    int32_t changes = 0;
    w->pass++;
    w->bad = w->next;
    w->next = swap;
    w->next.count = 0;
    for (int32_t k = 0; k < w->bad.count; k++) {
      int32_t t = w->bad.tet[k];
      int done_it = 0;
      cw_tet_prefetch_list(w, w->bad.tet, w->bad.count, k);
      if (w->mesh->tet[t].corner[0] < 0 || w->mesh->tet[t].quality >= w->limit) continue;
      if (pass <= 1 || cw_tet_has_changed(w, t)) CW_TRY(improve_one(w, t, move, pass >= 1, &done_it));
      changes += done_it;
      if (!done_it) CW_TRY(cw_tet_push(w, t));
    }
    if (changes == 0 && pass >= 1) break;
  }
done:
  return status;
}
