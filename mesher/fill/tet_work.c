// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_work.h"

#include <stdlib.h>

void cw_tet_work_free(CwTetWork *w) {
  free(w->bad.tet);
  free(w->next.tet);
}

CwStatus cw_tet_list_push(CwTetList *list, int32_t t) {
  CwStatus status = CW_OK;
  CW_GROW(list->tet, list->capacity, list->count + 1);
  list->tet[list->count++] = t;
done:
  return status;
}

CwStatus cw_tet_push(CwTetWork *w, int32_t t) {
  if (w->mesh->tet[t].pass == w->pass) return CW_OK;
  w->mesh->tet[t].pass = w->pass & CW_TET_NO_PASS;
  return cw_tet_list_push(&w->next, t);
}

CwStatus cw_tet_set_quality(CwTetWork *w, int32_t t, double quality) {
  CwStatus status = CW_OK;
  CwTet *tet = &w->mesh->tet[t];
  tet->quality = quality;
  for (int i = 0; i < 4; i++) w->mesh->point[tet->corner[i]].mark = w->pass;
  if (w->changed) CW_TRY(cw_tet_list_push(w->changed, t));
  if (quality < w->limit) CW_TRY(cw_tet_push(w, t));
done:
  return status;
}

CwStatus cw_tet_replace(CwTetWork *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                        const double *quality) {
  CwStatus status = CW_OK;
  int32_t slot[CW_CAVITY];
  CW_TRY(cw_tet_exchange(w->mesh, old_count, old, count, corner, slot));
  for (int k = 0; k < count; k++) CW_TRY(cw_tet_set_quality(w, slot[k], quality[k]));
done:
  return status;
}

CwStatus cw_tet_replace_sound(CwTetWork *w, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                              double least, int32_t *replaced) {
  CwStatus status = CW_OK;
  double quality[CW_CAVITY];
  for (int k = 0; k < count; k++) {
    quality[k] = cw_tet_quality_of(w, corner[k][0], corner[k][1], corner[k][2], corner[k][3]);
    if (!(quality[k] > 0.0 && quality[k] >= least)) goto done;
  }
  CW_TRY(cw_tet_replace(w, old_count, old, count, corner, quality));
  ++*replaced;
done:
  return status;
}
