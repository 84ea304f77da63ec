// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/layers.h"

#include <stdlib.h>

#include "mesher/layers/layers_inner.h"
#include "mesher/parallel/ledger.h"

// The columns as they came out.
typedef struct {
  const CwLayerWork *work;
  const CwLayers *layers;
} Columns;

static CwStatus find_height(void *context, int32_t v, void *out) {
  const Columns *columns = context;
  double d[3];
  cw_sub(columns->layers->front[v], columns->work->in->x[v], d);
  *(double *)out = cw_layers_least_cosine(columns->work, v, d);
  return CW_OK;
}

CwStatus cw_layers_make(const CwLayerInput *input, CwLayers *layers, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwLayerWork work = {0};
  CwBoxTree tree = {0};
  memset(layers, 0, sizeof *layers);
  cw_ledger_part("layers: neighbours");
  CW_TRY(cw_layers_topology(input, &work));
  CW_NEW(layers->front, work.n);
  CW_NEW(layers->height, work.n);
  CW_NEW(layers->reason, work.n);
  cw_ledger_part("layers: directions taken");
  CW_TRY_STAGE(cw_layers_normals(&work, outcome), outcome);
  cw_ledger_part("layers: tree");
  CW_TRY(cw_gap_tree_make(&work, &tree));
  CW_TRY(cw_layers_limit_by_hollow(&work));
  memcpy(work.t, work.most, work.n * sizeof *work.t);
  // The fan needs heights and the gap needs directions: twice is enough for both to settle.
  for (int pass = 0; pass < 2; pass++) {
    cw_ledger_part("layers: fans set");
    CW_TRY(cw_layers_fan(&work));
    cw_ledger_part("layers: grading");
    CW_TRY(cw_layers_limit_by_gap(&work, &tree));
    CW_TRY(cw_layers_grade(&work, NULL));
  }
  cw_ledger_part("layers: repair");
  CW_TRY(cw_layers_repair(&work, &tree, layers->front, &layers->repair_rounds));
  CW_TRY(cw_share("layers: heights", work.n, sizeof *layers->height, find_height, &(Columns){&work, layers},
                  layers->height));
  for (int32_t v = 0; v < work.n; v++) {
    layers->reason[v] = work.reason[v];
    if (layers->height[v] >= 0.99 * input->target[v]) continue;
    layers->thinned_count++;
    // Neither gap nor neighbours: the wall is so sharp there that the offset stops at its floor.
    if (work.reason[v] == CW_LAYER_FULL) layers->reason[v] = CW_LAYER_REPAIR;
  }
done:
  cw_box_tree_free(&tree);
  cw_layers_work_free(&work);
  if (status != CW_OK || outcome->kind != CW_OUTCOME_DONE) cw_layers_free(layers);
  return status;
}

void cw_layers_free(CwLayers *layers) {
  free(layers->front);
  free(layers->height);
  free(layers->reason);
  memset(layers, 0, sizeof *layers);
}
