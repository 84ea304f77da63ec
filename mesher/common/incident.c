// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/incident.h"

#include <stdlib.h>

CwStatus cw_incident_make(int32_t point_count, int32_t triangle_count, const int32_t (*triangle)[3], CwIncident *made) {
  CwStatus status = CW_OK;
  *made = (CwIncident){0};
  CW_NEW(made->start, (size_t)point_count + 1);
  CW_NEW(made->triangle, 3 * (size_t)triangle_count);
  int32_t *end = made->start; // where the lists end, until they are filled from behind
  for (int32_t t = 0; t < triangle_count; t++) {
    for (int k = 0; k < 3; k++) end[triangle[t][k]]++;
  }
  for (int32_t v = 0; v < point_count; v++) end[v + 1] += end[v];
  for (int32_t t = triangle_count - 1; t >= 0; t--) {
    for (int k = 0; k < 3; k++) made->triangle[--end[triangle[t][k]]] = t;
  }
done:
  if (status != CW_OK) cw_incident_free(made);
  return status;
}

void cw_incident_free(CwIncident *incident) {
  free(incident->start);
  free(incident->triangle);
  *incident = (CwIncident){0};
}
