// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/region_share.h"

#include <stdlib.h>

// The work on a cell of a periodic image, which is read and written alone, over that on another.
static const double COPY = 0.5;

static int same_counts(const CwMeshRegion *a, const CwMeshRegion *b) {
  return a->domain == b->domain && a->points == b->points && a->own_points == b->own_points &&
         a->tetrahedra == b->tetrahedra && a->pyramids == b->pyramids && a->prisms == b->prisms &&
         a->triangles == b->triangles && a->quads == b->quads;
}

void cw_region_share_free(CwRegionShare *share) {
  free(share->alike);
  free(share->owner);
  free(share->own);
  *share = (CwRegionShare){0};
}

CwStatus cw_region_share(const CwMesh *mesh, const CwRanks *ranks, CwRegionShare *share) {
  CwStatus status = CW_OK;
  const int count = mesh->region_count;
  double *work = NULL, *load = NULL; // of the set that begins with a region, of a rank
  CW_NEW(share->alike, count);
  CW_NEW(share->owner, count);
  CW_NEW(share->own, count);
  CW_NEW(work, count);
  CW_NEW(load, ranks->size);
  for (int r = 0; r < count; ++r) {
    int first = 0;
    while (first < r && (share->alike[first] != first || !same_counts(&mesh->regions[first], &mesh->regions[r])))
      ++first;
    share->alike[r] = first;
    share->owner[r] = -1;
    work[first] += (first == r ? 1 : COPY) * (double)cw_mesh_region_cells(&mesh->regions[r]);
  }
  for (;;) {
    int largest = -1, least = 0;
    for (int r = 0; r < count; ++r)
      if (share->alike[r] == r && share->owner[r] < 0 && (largest < 0 || work[r] > work[largest])) largest = r;
    if (largest < 0) break;
    for (int rank = 1; rank < ranks->size; ++rank)
      if (load[rank] < load[least]) least = rank;
    share->owner[largest] = least;
    load[least] += work[largest];
  }
  for (int first = 0; first < count; ++first)
    for (int r = first; r < count && share->alike[first] == first; ++r) {
      if (share->alike[r] != first) continue;
      share->owner[r] = share->owner[first];
      if (share->owner[r] == ranks->rank) share->own[share->own_count++] = r;
    }
done:
  free(work);
  free(load);
  return status;
}
