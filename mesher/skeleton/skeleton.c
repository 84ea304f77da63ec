// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/skeleton/skeleton.h"

#include <stdlib.h>
#include <string.h>

void cw_skeleton_free(CwSkeleton *skeleton) {
  cw_network_free(&skeleton->network);
  for (int32_t i = 0; i < skeleton->rim_count; i++) free(skeleton->rim[i].t);
  free(skeleton->rim);
  cw_orbit_free(&skeleton->orbits);
  free(skeleton->largest);
  free(skeleton->wall_x);
  free(skeleton->guide);
  free(skeleton->corner_vertex);
  free(skeleton->wall_triangle);
  free(skeleton->wall_face);
  free(skeleton->wall_region);
  free(skeleton->region_wall_start);
  free(skeleton->region_wall);
  free(skeleton->wall_source);
  free(skeleton->front);
  free(skeleton->height);
  free(skeleton->reason);
  free(skeleton->node_x);
  free(skeleton->on_plane);
  free(skeleton->corner_node);
  free(skeleton->tight);
  free(skeleton->cap_triangle);
  free(skeleton->cap_face);
  free(skeleton->cap_region);
  for (int32_t i = 0; i < skeleton->outline_count; i++) {
    free(skeleton->outline[i].loop_start);
    free(skeleton->outline[i].corner);
  }
  free(skeleton->outline);
  free(skeleton->interface_triangle);
  free(skeleton->interface_region);
  free(skeleton->planned_triangle);
  free(skeleton->planned_region);
  memset(skeleton, 0, sizeof *skeleton);
}

CwStatus cw_skeleton_adjacency(const CwSkeleton *skeleton, int32_t *pair_count, int32_t (**pair)[2]) {
  CwStatus status = CW_OK;
  int32_t regions = skeleton->plan->region_count;
  uint8_t *adjacent = NULL;
  CW_NEW(adjacent, (size_t)regions * (size_t)regions);
  *pair_count = 0;
  for (int32_t t = 0; t < skeleton->interface_triangle_count; t++) {
    const int32_t *region = skeleton->interface_region[t];
    int32_t low = region[0] < region[1] ? region[0] : region[1], high = region[0] < region[1] ? region[1] : region[0];
    uint8_t *mark = &adjacent[(size_t)low * (size_t)regions + (size_t)high];
    *pair_count += !*mark;
    *mark = 1;
  }
  CW_NEW(*pair, *pair_count);
  int32_t made = 0;
  for (int32_t low = 0; low < regions; low++) {
    for (int32_t high = low + 1; high < regions; high++) {
      if (!adjacent[(size_t)low * (size_t)regions + (size_t)high]) continue;
      (*pair)[made][0] = low;
      (*pair)[made++][1] = high;
    }
  }
done:
  free(adjacent);
  return status;
}
