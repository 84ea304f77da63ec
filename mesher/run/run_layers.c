// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_layers.h"

#include "mesher/heights/even_columns.h"
#include "mesher/heights/layer_heights.h"
#include "mesher/parallel/ledger.h"
#include "mesher/parallel/sides.h"
#include "pipeline/log.h"

// Of the work, what every rank of a group does for itself, and of that on a wall triangle what one takes that is a
// turned copy. Measured from 0.3 to 21 million cells.
static const double OWN_HEIGHTS = 0.3, COPIED_HEIGHTS = 0.15, OWN_LAYERS = 0.05, COPIED_LAYERS = 0.65;

// Returns the wall triangles.
static int64_t find_costs(const CwMeshRun *run, double copied, double cost[CW_DOMAINS_MOST]) {
  int64_t all = 0;
  for (int d = 0; d < run->domains.count; d++) {
    const CwSkeleton *skeleton = &run->domain[d].skeleton;
    int32_t firsts = 0;
    for (int32_t t = 0; t < skeleton->surface.triangle_count; t++) firsts += skeleton->surface.source[t] == t;
    cost[d] = firsts + copied * (skeleton->surface.triangle_count - firsts);
    all += skeleton->surface.triangle_count;
  }
  return all;
}

static CwStatus find_heights(void *context, int32_t d, CwOutcome *outcome) {
  CwMeshRun *run = context;
  return cw_domain_targets(&run->domain[d]);
}

static CwStatus hand_heights(void *context, const CwSideHand *hand) {
  CwStatus status = CW_OK;
  CwMeshRun *run = context;
  CwDomain *domain = &run->domain[hand->side];
  CwColumnHeights *heights = &domain->heights;
  int32_t n = domain->skeleton.surface.vertex_count;
  heights->layer_count = domain->layer_count;
  CW_SIDE_ARRAY(hand, heights->first_height, n);
  CW_SIDE_ARRAY(hand, heights->growth, n);
  CW_SIDE_ARRAY(hand, heights->target, n);
  CW_SIDE_ARRAY(hand, heights->least, n);
  cw_side_give(hand, &domain->layer_share, sizeof domain->layer_share);
done:
  return status;
}

CwStatus cw_run_heights(CwMeshRun *run) {
  CwOutcome outcome[CW_DOMAINS_MOST]; // all done: heights are never tried another way
  double cost[CW_DOMAINS_MOST];
  find_costs(run, COPIED_HEIGHTS, cost);
  CwSides sides = {.step = "heights of the layers",
                   .count = run->domains.count,
                   .cost = cost,
                   .own = OWN_HEIGHTS,
                   .run = find_heights,
                   .hand = hand_heights,
                   .context = run};
  return cw_sides_run(&sides, outcome);
}

// Share of the column over a vertex that its last layer takes where it is so high.
static double last_layer(const void *context, int32_t vertex, double height) {
  const CwColumnHeights *heights = context;
  double fraction[CW_LAYERS_MOST + 1];
  cw_layer_fractions(height, heights->first_height[vertex], heights->layer_count, heights->growth[vertex], fraction);
  return 1 - fraction[heights->layer_count - 1];
}

static CwStatus grow(void *context, int32_t d, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwMeshRun *run = context;
  CwDomain *domain = &run->domain[d];
  CwLayerDivision division = {domain->layer_count, last_layer, &domain->heights};
  CW_TRY_STAGE(cw_skeleton_grow(&domain->skeleton, &domain->background, domain->heights.target, domain->heights.least,
                                &division, outcome),
               outcome);
  cw_ledger_part("layers: small prisms");
  CW_TRY(cw_column_heights_even(&domain->heights, &domain->skeleton));
done:
  return status;
}

static CwStatus hand_layers(void *context, const CwSideHand *hand) {
  CwStatus status = CW_OK;
  CwMeshRun *run = context;
  CwDomain *domain = &run->domain[hand->side];
  CwSkeleton *skeleton = &domain->skeleton;
  int32_t n = skeleton->surface.vertex_count;
  cw_side_give(hand, skeleton->surface.triangle,
               skeleton->surface.triangle_count * (int64_t)sizeof *skeleton->surface.triangle);
  CW_SIDE_ARRAY(hand, skeleton->layers.front, n);
  CW_SIDE_ARRAY(hand, skeleton->layers.height, n);
  CW_SIDE_ARRAY(hand, skeleton->layers.reason, n);
  CW_SIDE_ARRAY(hand, domain->heights.first_made, n);
done:
  return status;
}

CwStatus cw_run_layers(CwMeshRun *run, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwOutcome of_domain[CW_DOMAINS_MOST];
  double started = cw_seconds(), cost[CW_DOMAINS_MOST];
  int64_t faces = find_costs(run, COPIED_LAYERS, cost);
  CwSides sides = {.step = "layers",
                   .count = run->domains.count,
                   .cost = cost,
                   .own = OWN_LAYERS,
                   .run = grow,
                   .hand = hand_layers,
                   .context = run};
  cw_progress_start("layers", faces, "wall faces");
  CW_TRY(cw_sides_run(&sides, of_domain));
  *outcome = cw_outcomes_first(run->domains.count, of_domain);
  if (outcome->kind == CW_OUTCOME_DONE) cw_progress(faces);
  cw_progress_end();
  if (outcome->kind != CW_OUTCOME_DONE) goto done;
  if (run->rank == 0)
    CW_TRY(cw_record_step(run->record, "layers", cw_seconds() - started, run->domains.count, "domains"));
done:
  return status;
}
