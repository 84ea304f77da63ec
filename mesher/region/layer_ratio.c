// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/layer_ratio.h"

#include <stdlib.h>

#include "mesher/common/quality.h"
#include "pipeline/mesh/cell.h"
#include "mesher/common/vec.h"

static const double bin_end[CW_RATIO_BINS - 1] = {0.25, 0.5, 0.75, 1, 1.25, 1.5, 2};

typedef struct {
  int32_t corner[3]; // ascending
  int32_t triangle;  // of the wall
  int32_t wall;      // its number among those
} End;

static End end_of(int32_t a, int32_t b, int32_t c, int32_t triangle, int32_t wall) {
  End end = {{a, b, c}, triangle, wall};
  for (int pass = 0; pass < 2; pass++) {
    for (int k = 0; k < 2 - pass; k++) {
      if (end.corner[k] <= end.corner[k + 1]) continue;
      int32_t swap = end.corner[k];
      end.corner[k] = end.corner[k + 1];
      end.corner[k + 1] = swap;
    }
  }
  return end;
}

static int compare_ends(const void *p, const void *q) {
  const End *a = p, *b = q;
  for (int k = 0; k < 3; k++) {
    if (a->corner[k] != b->corner[k]) return a->corner[k] < b->corner[k] ? -1 : 1;
  }
  return 0;
}

static double prism_volume(const CwRegionMesh *mesh, int32_t prism) {
  const double *x[6];
  for (int k = 0; k < 6; k++) x[k] = mesh->x[mesh->prism[prism][k]];
  return cw_cell_volume(6, x);
}

CwStatus cw_layer_ratio(const CwRegionMesh *mesh, int layers, const CwRatioWall *wall, int patches,
                        CwLayerRatio *ratio) {
  CwStatus status = CW_OK;
  End *end = NULL;
  uint8_t *on_end = NULL;
  int32_t count = 0, met = 0;
  CW_NEW(end, mesh->triangle_count);
  CW_NEW(on_end, mesh->point_count);
  for (int32_t t = 0; t < mesh->triangle_count; t++) {
    int32_t prism = mesh->triangle_cell[t] - mesh->tetrahedron_count - mesh->pyramid_count + layers - 1;
    if (mesh->triangle_cell[t] < mesh->tetrahedron_count) continue;
    const int32_t *top = mesh->prism[prism] + 3;
    end[count] = end_of(top[0], top[1], top[2], t, count);
    count++;
    for (int k = 0; k < 3; k++) on_end[top[k]] = 1;
  }
  qsort(end, (size_t)count, sizeof *end, compare_ends);
  for (int32_t c = 0; c < mesh->tetrahedron_count; c++) {
    const int32_t *corner = mesh->tetrahedron[c];
    if (on_end[corner[0]] + on_end[corner[1]] + on_end[corner[2]] + on_end[corner[3]] < 3) continue;
    for (int k = 0; k < 4; k++) {
      End key = end_of(corner[(k + 1) % 4], corner[(k + 2) % 4], corner[(k + 3) % 4], 0, 0);
      const End *found = bsearch(&key, end, (size_t)count, sizeof *end, compare_ends);
      if (!found) continue;
      int32_t t = found->triangle, patch = mesh->triangle_patch[t];
      int32_t prism = mesh->triangle_cell[t] - mesh->tetrahedron_count - mesh->pyramid_count + layers - 1;
      // Both over the same face: its area cancels.
      double tet = cw_tet_volume6(mesh->x[corner[0]], mesh->x[corner[1]], mesh->x[corner[2]], mesh->x[corner[3]]) / 2;
      double over = prism_volume(mesh, prism) / tet;
      met++;
      if (patch >= patches) continue;
      int at = 0;
      while (at < CW_RATIO_BINS - 1 && over > bin_end[at]) at++;
      ratio[patch].bin[at]++;
      if (wall[found->wall].cramped) continue;
      // The height of the tetrahedron: its volume over a third of the face, which has a normal of twice its area.
      double u[3], v[3], normal[3];
      const int32_t *top = mesh->prism[prism] + 3;
      cw_sub(mesh->x[top[1]], mesh->x[top[0]], u);
      cw_sub(mesh->x[top[2]], mesh->x[top[0]], v);
      cw_cross(u, v, normal);
      double height = 2 * tet / cw_norm(normal);
      double most = over * wall[found->wall].last / wall[found->wall].made;
      if (wall[found->wall].first > 1.5 * height || most < 0.5) continue;
      ratio[patch].within++;
      ratio[patch].fair_within += at >= 2 && at <= 5;
    }
  }
  CW_REQUIRE(met == count, CW_ERR_MESH, "%s region %d: %d of %d columns have no tetrahedron on their ends",
             mesh->domain, mesh->region, count - met, count);
done:
  free(end);
  free(on_end);
  return status;
}
