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
  cw_surface_mesh_free(&skeleton->surface);
  cw_layers_free(&skeleton->layers);
  cw_interfaces_free(&skeleton->interfaces);
  memset(skeleton, 0, sizeof *skeleton);
}

CwStatus cw_skeleton_adjacency(const CwSkeleton *skeleton, int32_t *pair_count, int32_t (**pair)[2]) {
  CwStatus status = CW_OK;
  int32_t regions = skeleton->plan->region_count;
  uint8_t *adjacent = NULL;
  CW_NEW(adjacent, (size_t)regions * (size_t)regions);
  *pair_count = 0;
  for (int32_t t = 0; t < skeleton->interfaces.refined.count; t++) {
    const int32_t *region = skeleton->interfaces.refined.region[t];
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
