// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/give_back.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/common/vtk.h"
#include "mesher/layers/direction_smoothing.h"
#include "mesher/layers/layers_gap.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_repair.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/parallel/profiler.h"
#include "mesher/policy.h"

// The columns as they came out.
typedef struct {
  const CwLayerWork *work;
  const CwLayers *layers;
} Columns;

static CwStatus find_thickness(void *context, int32_t v, void *out) {
  const Columns *columns = context;
  double d[3];
  cw_sub(columns->layers->top[v], columns->work->in->x[v], d);
  *(double *)out = cw_layers_least_cosine(columns->work, v, d);
  return CW_OK;
}

CwStatus cw_layers_make(const CwLayerInput *input, CwLayers *layers, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwLayerWork work = {0};
  CwBoxTree tree = {0};
  memset(layers, 0, sizeof *layers);
  cw_profiler_part(input->context, "layers: neighbours");
  CW_TRY(cw_layers_topology(input, &work));
  layers->column_count = work.n;
  CW_NEW(layers->top, work.n);
  CW_NEW(layers->thickness, work.n);
  CW_NEW(layers->reason, work.n);
  cw_profiler_part(input->context, "layers: directions taken");
  CW_TRY_STAGE(cw_layers_normals(&work, outcome), outcome);
  cw_profiler_part(input->context, "layers: tree");
  CW_TRY(cw_gap_tree_make(&work, &tree));
  CW_TRY(cw_layers_limit_by_concavity(&work));
  memcpy(work.t, work.most, work.n * sizeof *work.t);
  // The smoothing needs thicknesses and the gap needs directions: twice is enough for both to settle.
  for (int pass = 0; pass < 2; pass++) {
    cw_profiler_part(input->context, "layers: smoothing set up");
    CW_TRY(cw_smooth_directions(&work));
    cw_profiler_part(input->context, "layers: grading");
    CW_TRY(cw_layers_limit_by_gap(&work, &tree));
    CW_TRY(cw_layers_grade(&work, NULL));
  }
  cw_give_back(); // the blocks of the smoothing lie in the memory of each thread
  cw_profiler_part(input->context, "layers: repair");
  CW_TRY_STAGE(cw_layers_repair(&work, &tree, layers->top, &layers->repair_rounds, outcome), outcome);
  CW_TRY(cw_parallel_for(input->context, "layers: thicknesses", work.n, sizeof *layers->thickness, find_thickness,
                         &(Columns){&work, layers}, layers->thickness));
  for (int32_t v = 0; v < work.n; v++) {
    layers->reason[v] = work.reason[v];
    if (layers->thickness[v] >= 0.99 * input->target[v]) continue;
    layers->thinned_count++;
    // The offset stops at its floor (cw_layers_floor): alone, or whatever else thins it; and the neighbours follow.
    int32_t foot = cw_layers_slope_foot(&work, v);
    int sharp = work.crease[foot] != CW_CREASE_CONCAVE && work.normal_cos[foot] < cw_policy.upright_cosine;
    if (work.reason[foot] == CW_LAYER_TAPER)
      layers->reason[v] = CW_LAYER_TAPER;
    else if (sharp || work.reason[v] == CW_LAYER_FULL)
      layers->reason[v] = CW_LAYER_SHARPNESS;
  }
done:
  cw_box_tree_free(&tree);
  cw_smoothing_free(&work.smoothing);
  cw_layers_work_free(&work);
  if (status != CW_OK || outcome->kind != CW_OUTCOME_DONE) cw_layers_free(layers);
  return status;
}

CwStatus cw_layers_audit(const CwLayers *layers, const double (*x)[3]) {
  CwStatus status = CW_OK;
  for (int32_t v = 0; v < layers->column_count; v++) {
    const double length = cw_distance(layers->top[v], x[v]);
    CW_REQUIRE(layers->thickness[v] > 0 || (layers->thickness[v] == 0 && length == 0), CW_ERR_FAULT,
               "layers: the column at (%.3f, %.3f, %.3f) mm is %g mm thick and %g mm long", CW_MM(x[v]),
               cw_mm(layers->thickness[v]), cw_mm(length));
  }
  for (int32_t t = 0; t < layers->triangle_count; t++) {
    const int32_t *corner = layers->triangle[t];
    const double *wall[3], *top[3];
    for (int k = 0; k < 3; k++) {
      CW_REQUIRE(corner[k] >= 0 && corner[k] < layers->column_count && corner[k] != corner[(k + 1) % 3], CW_ERR_FAULT,
                 "layers: triangle %d has the corners %d, %d, %d of %d columns", t, corner[0], corner[1], corner[2],
                 layers->column_count);
      wall[k] = x[corner[k]];
      top[k] = layers->top[corner[k]];
    }
    double quality = cw_prism_quality(wall, top);
    CW_REQUIRE(quality > 0, CW_ERR_FAULT,
               "layers: the prism over triangle %d at (%.3f, %.3f, %.3f) mm has a quality of %g", t, CW_MM(wall[0]),
               quality);
  }
done:
  return status;
}

CwStatus cw_layers_vtk(const CwLayers *layers, const int32_t *region, const char *path) {
  CwStatus status = CW_OK;
  int32_t *reason = NULL;
  CW_NEW(reason, layers->triangle_count);
  for (int32_t t = 0; t < layers->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t of = layers->reason[layers->triangle[t][k]];
      if (of > reason[t]) reason[t] = of;
    }
  }
  const CwVtkField field[2] = {{"reason", reason, NULL}, {"region", region, NULL}};
  const CwVtkTriangles triangles = {.title = "layer top",
                                    .point_count = layers->column_count,
                                    .x = (const double(*)[3])layers->top,
                                    .triangle_count = layers->triangle_count,
                                    .triangle = (const int32_t(*)[3])layers->triangle,
                                    .field_count = 2,
                                    .field = field};
  CW_TRY(cw_vtk_write(path, &triangles));
done:
  free(reason);
  return status;
}

void cw_layers_arrays(void *product, CwArrayVisit visit, void *given) {
  CwLayers *layers = product;
  CW_SHOW(visit, given, layers->triangle, layers->triangle_count);
  CW_SHOW(visit, given, layers->top, layers->column_count);
  CW_SHOW(visit, given, layers->thickness, layers->column_count);
  CW_SHOW(visit, given, layers->reason, layers->column_count);
  CW_SHOW(visit, given, layers->first_height, layers->column_count);
}

void cw_layers_free(CwLayers *layers) {
  cw_arrays_free(layers, cw_layers_arrays, &layers->memory);
  memset(layers, 0, sizeof *layers);
}
