// SPDX-License-Identifier: AGPL-3.0-or-later
// Items listed by the group that each belongs to, as the triangles around each vertex of a surface.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

// Those of group g are member[start[g]] .. member[start[g + 1] - 1], ascending. start: groups + 1, zeroed.
void cw_list_by_group(int32_t count, const int32_t *group, int32_t groups, int32_t *start, int32_t *member);

typedef struct {
  int32_t *start;    // point_count + 1
  int32_t *triangle; // of vertex v: start[v] .. start[v + 1] - 1, ascending
} CwIncident;

CwStatus cw_incident_make(int32_t point_count, int32_t triangle_count, const int32_t (*triangle)[3], CwIncident *made);
void cw_incident_free(CwIncident *incident);
