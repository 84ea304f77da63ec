// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/region_check.h"

#include <math.h>
#include <stdlib.h>

#include "pipeline/mesh/cell.h"

static CwStatus check_volumes(const char *path, const CwRegionData *data, CwRegionFigures *figures, CwMiddle *middle) {
  CwStatus status = CW_OK;
  *figures = (CwRegionFigures){.least_volume = INFINITY};
  cw_face_quality_start(&figures->faces);
  for (int32_t cell = 0, cells = cw_region_cell_count(data); cell < cells; ++cell) {
    middle[cell] = cw_cell_middle(data, cell);
    const double one = middle[cell].volume;
    if (!(one > 0)) {
      double centre[3];
      cw_cell_centre(data, cell, centre);
      CW_REQUIRE(0, CW_ERR_INPUT, "%s: cell %d at (%.6g, %.6g, %.6g) mm has a volume of %.3g mm3; it must be above 0",
                 path, cell, 1e3 * centre[0], 1e3 * centre[1], 1e3 * centre[2], 1e9 * one);
    }
    figures->volume += one;
    figures->least_volume = one < figures->least_volume ? one : figures->least_volume;
  }
done:
  return status;
}

static CwStatus check_points(const char *path, const CwRegionData *data) {
  CwStatus status = CW_OK;
  unsigned char *used = NULL;
  CW_NEW(used, data->point_count);
  for (int32_t cell = 0, cells = cw_region_cell_count(data); cell < cells; ++cell) {
    int count;
    const int32_t *nodes = cw_cell_nodes(data, cell, &count);
    for (int i = 0; i < count; ++i) used[nodes[i]] = 1;
  }
  for (int32_t p = 0; p < data->point_count; ++p) {
    const double *x = data->points[p];
    CW_REQUIRE(used[p], CW_ERR_INPUT, "%s: point %d at (%.6g, %.6g, %.6g) mm is used by no cell", path, p, 1e3 * x[0],
               1e3 * x[1], 1e3 * x[2]);
  }
done:
  free(used);
  return status;
}

CwStatus cw_region_check(const CwAssembly *a, int region, const CwRegionData *data, CwRegionFaces *faces,
                         CwRegionFigures *figures) {
  CwStatus status = CW_OK;
  const CwRegionPlace *place = &a->places[region];
  const char *path = a->mesh->regions[region].path;
  int64_t open = (region + 1 < a->mesh->region_count ? place[1].open : a->open_count) - place->open;
  CwMiddle *middle = NULL;
  CW_NEW_UNSET(middle, cw_region_cell_count(data));
  CW_TRY(check_volumes(path, data, figures, middle));
  CW_TRY(cw_region_faces(path, CW_ERR_INPUT, data, faces));
  CW_TRY(check_points(path, data));
  cw_face_quality_region(data, faces, middle, &figures->faces);
  CW_REQUIRE(faces->inner_triangles == place->inner_triangles && faces->inner_quads == place->inner_quads &&
                 faces->open_count == open,
             CW_ERR_INPUT, "%s: has other faces than when it was first read", path);
done:
  free(middle);
  return status;
}

void cw_region_figures_sum(const CwRanks *ranks, CwRegionFigures *figures, CwAssembly *a) {
  for (int r = 0; r < a->mesh->region_count; ++r) {
    CwDomainTotal *total = &a->totals[a->mesh->regions[r].domain];
    MPI_Bcast(&figures[r], sizeof *figures, MPI_BYTE, r % ranks->size, ranks->comm);
    total->least_volume =
        total->volume > 0 ? fmin(total->least_volume, figures[r].least_volume) : figures[r].least_volume;
    total->volume += figures[r].volume;
    cw_face_quality_add(&figures[r].faces, &total->faces);
  }
}
