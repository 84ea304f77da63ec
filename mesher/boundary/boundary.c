// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/boundary.h"

#include <stdlib.h>
#include <string.h>

void cw_boundary_free(CwBoundary *boundary) {
  cw_network_free(&boundary->network);
  for (int32_t i = 0; i < boundary->open_edge_count; i++) free(boundary->open_edge[i].t);
  free(boundary->open_edge);
  cw_periodic_images_free(&boundary->images);
  free(boundary->largest);
  cw_wall_curves_free(&boundary->wall_curves);
  cw_surface_mesh_free(&boundary->surface);
  cw_layers_free(&boundary->layers);
  cw_interfaces_free(&boundary->interfaces);
  memset(boundary, 0, sizeof *boundary);
}

CwStatus cw_boundary_adjacency(const CwBoundary *boundary, int32_t *pair_count, int32_t (**pair)[2]) {
  CwStatus status = CW_OK;
  int32_t regions = boundary->plan->region_count;
  uint8_t *adjacent = NULL;
  CW_NEW(adjacent, (size_t)regions * (size_t)regions);
  *pair_count = 0;
  for (int32_t t = 0; t < boundary->interfaces.refined.count; t++) {
    const int32_t *region = boundary->interfaces.refined.region[t];
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
