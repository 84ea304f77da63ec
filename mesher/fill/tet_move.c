// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_move.h"

#include <math.h>
#include <string.h>

#include "mesher/fill/tet_cavity.h"
#include "mesher/policy.h"

CwStatus cw_tet_move_point(CwTetWork *w, int32_t t, int32_t point, int *done_it) {
  CwStatus status = CW_OK;
  int32_t star[CW_STAR];
  CwCavity cavity;
  double p[3], least = INFINITY;
  *done_it = 0;
  if (w->mesh->source[point] < w->fixed_count) goto done;
  int n = cw_tet_star(w->mesh, t, point, CW_STAR, star);
  cavity.count = n;
  for (int k = 0; k < n; k++) {
    const CwTet *tet = &w->mesh->tet[star[k]];
    int corner = cw_tet_corner_of(tet, point);
    // Inward: (face, point) positive.
    for (int i = 0; i < 3; i++) cavity.face[k][i] = cw_tet_at(w, tet->corner[cw_tet_face[corner][2 - i]]);
    if (tet->quality < least) least = tet->quality;
  }
  if (n == 0) goto done;
  memcpy(p, cw_tet_at(w, point), sizeof p);
  if (!(cw_cavity_best(&cavity, p, least) > least + cw_policy.least_gain)) goto done;
  memcpy(w->mesh->point[point].x, p, sizeof p);
  for (int k = 0; k < n; k++) {
    const int32_t *c = w->mesh->tet[star[k]].corner;
    CW_TRY(cw_tet_set_quality(w, star[k], cw_tet_quality_of(w, c[0], c[1], c[2], c[3])));
  }
  w->count.points_moved++;
  *done_it = 1;
done:
  return status;
}
