// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_bound.h"

#include "mesher/common/incident.h"

CwStatus cw_tet_bound(const CwFillInput *boundary, double *degrees, int32_t *worst) {
  CwStatus status = CW_OK;
  CwIncident around = {0};
  *degrees = CW_TET_BOUND_MOST;
  *worst = -1;
  CW_TRY(cw_incident_make(boundary->point_count, boundary->triangle_count, boundary->triangle, &around));
  const CwBoundSurface surface = {boundary->triangle, boundary->x, around.start, around.triangle};
  for (int32_t t = 0; t < boundary->triangle_count; t++) {
    double bound = cw_bound_on(&surface, t, *degrees);
    if (bound < *degrees) *degrees = bound, *worst = t;
  }
done:
  cw_incident_free(&around);
  return status;
}
