// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/boundary.h"

#include <stdlib.h>

void cw_open_edges_free(CwOpenEdges *edges) {
  for (int32_t i = 0; i < edges->count; i++) free(edges->edge[i].t);
  free(edges->edge);
  *edges = (CwOpenEdges){0};
}

CwStatus cw_interfaces_adjacency(const CwInterfaces *interfaces, int32_t regions, int32_t *pair_count,
                                 int32_t (**pair)[2]) {
  CwStatus status = CW_OK;
  uint8_t *adjacent = NULL;
  CW_NEW(adjacent, (size_t)regions * (size_t)regions);
  *pair_count = 0;
  for (int32_t t = 0; t < interfaces->refined.count; t++) {
    const int32_t *region = interfaces->refined.region[t];
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
