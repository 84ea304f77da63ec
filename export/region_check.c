// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/region_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"

static const double TURN_ROUNDING = 2e-15; // of the greatest coordinate, and of a cosine: a few roundings

static CwStatus check_volumes(const char *path, const CwRegionData *data, CwRegionFigures *figures, CwMiddle *middle) {
  CwStatus status = CW_OK;
  *figures = (CwRegionFigures){.least_volume = INFINITY};
  cw_face_quality_start(&figures->faces);
  for (int32_t cell = 0, cells = cw_region_cell_count(data); cell < cells; ++cell) {
    middle[cell] = cw_cell_middle(data, cell);
    const double one = middle[cell].volume;
    double centre[3] = {0};
    if (!(one > 0)) cw_cell_centre(data, cell, centre);
    CW_REQUIRE(one > 0, CW_ERR_INPUT,
               "%s: cell %d at (%.6g, %.6g, %.6g) mm has a volume of %.3g mm3; it must be above 0", path, cell,
               1e3 * centre[0], 1e3 * centre[1], 1e3 * centre[2], 1e9 * one);
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

static int same_bytes(const void *a, const void *b, size_t count, size_t size) {
  return count == 0 || memcmp(a, b, count * size) == 0;
}

// Whether a region of the same counts (region_share.h) has the same cells and boundary faces, and its points are those
// of the model turned about the axis.
static int is_turned_copy(const CwRegionData *model, const CwRegionData *data) {
  const size_t triangles = (size_t)data->triangle_count, quads = (size_t)data->quad_count;
  double greatest = 0, squares = 0;
  int32_t far = 0;
  if (!same_bytes(model->tetrahedra, data->tetrahedra, (size_t)data->tetrahedron_count, sizeof *data->tetrahedra) ||
      !same_bytes(model->pyramids, data->pyramids, (size_t)data->pyramid_count, sizeof *data->pyramids) ||
      !same_bytes(model->prisms, data->prisms, (size_t)data->prism_count, sizeof *data->prisms) ||
      !same_bytes(model->triangles, data->triangles, triangles, sizeof *data->triangles) ||
      !same_bytes(model->triangle_cell, data->triangle_cell, triangles, sizeof *data->triangle_cell) ||
      !same_bytes(model->quads, data->quads, quads, sizeof *data->quads) ||
      !same_bytes(model->quad_cell, data->quad_cell, quads, sizeof *data->quad_cell))
    return 0;
  for (int32_t p = 0; p < model->point_count; ++p) {
    const double *x = model->points[p], square = x[0] * x[0] + x[1] * x[1];
    greatest = fmax(greatest, fmax(square, x[2] * x[2]));
    if (square > squares) far = p;
    squares = fmax(squares, square);
  }
  if (!(squares > 0)) return 0;
  const double *x = model->points[far], *y = data->points[far], most = TURN_ROUNDING * sqrt(greatest);
  const double c = (x[0] * y[0] + x[1] * y[1]) / squares, s = (x[0] * y[1] - x[1] * y[0]) / squares;
  if (!(fabs(c * c + s * s - 1) <= 2 * TURN_ROUNDING)) return 0; // stretched
  for (int32_t p = 0; p < model->point_count; ++p) {
    x = model->points[p];
    y = data->points[p];
    if (!(fabs(c * x[0] - s * x[1] - y[0]) <= most && fabs(s * x[0] + c * x[1] - y[1]) <= most &&
          fabs(x[2] - y[2]) <= most))
      return 0;
  }
  return 1;
}

static CwStatus check_counts(const CwAssembly *a, int region, const CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  const CwRegionPlace *place = &a->places[region];
  CW_REQUIRE(faces->inner_triangles == place->inner.triangles && faces->inner_quads == place->inner.quads &&
                 faces->open_count == place->open_count,
             CW_ERR_INPUT, "%s: has other faces than when it was first read; another program has changed it",
             a->mesh->regions[region].path);
done:
  return status;
}

void cw_region_model_free(CwRegionModel *model) {
  if (model->kept) cw_mesh_region_free(&model->data);
  cw_region_faces_free(&model->faces);
  cw_flat_prisms_free(&model->flat);
  *model = (CwRegionModel){0};
}

CwStatus cw_region_check(const CwAssembly *a, int region, const CwRegionData *data, CwRegionModel *model) {
  CwStatus status = CW_OK;
  const char *path = a->mesh->regions[region].path;
  CwMiddle *middle = NULL;
  if (!model->kept || a->share.alike[region] != a->share.alike[model->region] || !is_turned_copy(&model->data, data)) {
    cw_region_model_free(model);
    model->region = region;
    CW_NEW_UNSET(middle, cw_region_cell_count(data));
    CW_TRY(check_volumes(path, data, &model->figures, middle));
    CW_TRY(cw_region_faces(path, CW_ERR_INPUT, data, &model->faces));
    CW_TRY(check_points(path, data));
    CW_TRY(cw_face_quality_region(data, &model->faces, middle, &model->figures.faces, &model->flat));
  }
  model->figures.faces.slender = cw_flat_prisms_slender(&model->flat, data);
  CW_TRY(check_counts(a, region, &model->faces));
done:
  free(middle);
  return status;
}

void cw_region_model_keep(const CwAssembly *a, int region, CwRegionData *data, CwRegionModel *model) {
  int more = 0;
  for (int r = 0; r < region; ++r) more |= a->share.alike[r] == a->share.alike[region];
  if (!more) {
    cw_region_model_free(model);
  } else if (!model->kept) {
    model->data = *data;
    model->kept = 1;
    *data = (CwRegionData){0};
  }
}

void cw_region_figures_sum(const CwRanks *ranks, CwRegionFigures *figures, CwAssembly *a) {
  for (int r = 0; r < a->mesh->region_count; ++r) {
    CwDomainTotal *total = &a->totals[a->mesh->regions[r].domain];
    MPI_Bcast(&figures[r], sizeof *figures, MPI_BYTE, a->share.owner[r], ranks->comm);
    total->least_volume =
        total->volume > 0 ? fmin(total->least_volume, figures[r].least_volume) : figures[r].least_volume;
    total->volume += figures[r].volume;
    cw_face_quality_add(&figures[r].faces, &total->faces);
  }
}
