// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/incident.h"

#include <stdlib.h>

void cw_list_by_group(int32_t count, const int32_t *group, int32_t groups, int32_t *start, int32_t *member) {
  for (int32_t i = 0; i < count; i++) start[group[i]]++;
  for (int32_t g = 0; g < groups; g++) start[g + 1] += start[g]; // where the lists end; they are filled from behind
  for (int32_t i = count; i-- > 0;) member[--start[group[i]]] = i;
}

CwStatus cw_incident_make(int32_t point_count, int32_t triangle_count, const int32_t (*triangle)[3], CwIncident *made) {
  CwStatus status = CW_OK;
  *made = (CwIncident){0};
  CW_NEW(made->start, (size_t)point_count + 1);
  CW_NEW(made->triangle, 3 * (size_t)triangle_count);
  if (triangle_count > 0) cw_list_by_group(3 * triangle_count, *triangle, point_count, made->start, made->triangle);
  for (int32_t i = 0; i < 3 * triangle_count; i++) made->triangle[i] /= 3; // corners
done:
  if (status != CW_OK) cw_incident_free(made);
  return status;
}

void cw_incident_free(CwIncident *incident) {
  free(incident->start);
  free(incident->triangle);
  *incident = (CwIncident){0};
}
