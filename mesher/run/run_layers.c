// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_layers.h"

#include "mesher/parallel/groups.h"
#include "mesher/parallel/profiler.h"
#include "mesher/thickness/even_columns.h"
#include "mesher/thickness/layer_thickness.h"
#include "pipeline/log.h"

// Of the work, what every rank of a group does for itself, and of that on a wall triangle what one takes that is a
// periodic image. Measured from 0.3 to 21 million cells.
static const double OWN_THICKNESS = 0.3, COPIED_THICKNESS = 0.15, OWN_LAYERS = 0.05, COPIED_LAYERS = 0.65;

// Returns the wall triangles.
static int64_t find_costs(const CwMeshRun *run, double copied, double cost[CW_DOMAINS_MOST]) {
  int64_t all = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwSurfaceMesh *surface = &run->domain[d].surface;
    int32_t firsts = 0;
    for (int32_t t = 0; t < surface->triangle_count; t++) firsts += surface->source[t] == t;
    cost[d] = firsts + copied * (surface->triangle_count - firsts);
    all += surface->triangle_count;
  }
  return all;
}

static CwStatus find_thickness(void *given, const CwContext *context, int32_t d, CwOutcome *outcome) {
  CwMeshRun *run = given;
  return cw_domain_targets(context, &run->domain[d]);
}

static CwStatus hand_thickness(void *given, const CwGroupHand *hand) {
  CwStatus status = CW_OK;
  CwMeshRun *run = given;
  CwDomain *domain = &run->domain[hand->item];
  CwColumnTargets *targets = &domain->targets;
  int32_t n = domain->surface.vertex_count;
  targets->layer_count = domain->layer_count;
  CW_GROUP_ARRAY(hand, targets->first_height, n);
  CW_GROUP_ARRAY(hand, targets->growth, n);
  CW_GROUP_ARRAY(hand, targets->target, n);
  CW_GROUP_ARRAY(hand, targets->least, n);
  cw_group_give(hand, &domain->layer_share, sizeof domain->layer_share);
done:
  return status;
}

CwStatus cw_run_thickness(CwMeshRun *run) {
  CwOutcome outcome[CW_DOMAINS_MOST]; // all done: thicknesses are never tried another way
  double cost[CW_DOMAINS_MOST];
  find_costs(run, COPIED_THICKNESS, cost);
  CwGroupWork work = {.step = "thicknesses of the layers",
                      .count = run->model.domain_count,
                      .cost = cost,
                      .own = OWN_THICKNESS,
                      .run = find_thickness,
                      .hand = hand_thickness,
                      .given = run};
  return cw_groups_run(&run->context, &work, outcome);
}

// Share of the column over a vertex that its last layer takes where it is so high.
static double last_layer(const void *context, int32_t vertex, double thickness) {
  const CwColumnTargets *targets = context;
  double fraction[CW_LAYERS_MOST + 1];
  cw_layer_fractions(thickness, targets->first_height[vertex], targets->layer_count, targets->growth[vertex], fraction);
  return 1 - fraction[targets->layer_count - 1];
}

static CwStatus grow(void *given, const CwContext *context, int32_t d, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwMeshRun *run = given;
  CwDomain *domain = &run->domain[d];
  CwLayerDivision division = {domain->layer_count, last_layer, &domain->targets};
  CW_TRY_STAGE(cw_boundary_grow(context, &domain->input, &domain->surface, &domain->background, domain->targets.target,
                                domain->targets.least, &division, &domain->layers, outcome),
               outcome);
  CW_AUDIT(cw_layers_audit(&domain->layers, (const double(*)[3])domain->surface.x));
  cw_profiler_part(context, "layers: small prisms");
  CW_TRY(cw_column_targets_even(context, &domain->targets, &domain->surface, &domain->layers));
done:
  return status;
}

static CwStatus hand_layers(void *given, const CwGroupHand *hand) {
  CwStatus status = CW_OK;
  CwMeshRun *run = given;
  CwDomain *domain = &run->domain[hand->item];
  CwLayers *layers = &domain->layers;
  int32_t n = layers->column_count = domain->surface.vertex_count;
  layers->triangle_count = domain->surface.triangle_count;
  CW_GROUP_ARRAY(hand, layers->triangle, layers->triangle_count);
  CW_GROUP_ARRAY(hand, layers->top, n);
  CW_GROUP_ARRAY(hand, layers->thickness, n);
  CW_GROUP_ARRAY(hand, layers->reason, n);
  CW_GROUP_ARRAY(hand, domain->targets.first_made, n);
done:
  return status;
}

CwStatus cw_run_layers(CwMeshRun *run, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwOutcome of_domain[CW_DOMAINS_MOST];
  double started = cw_seconds(), cost[CW_DOMAINS_MOST];
  int64_t faces = find_costs(run, COPIED_LAYERS, cost);
  CwGroupWork work = {.step = "layers",
                      .count = run->model.domain_count,
                      .cost = cost,
                      .own = OWN_LAYERS,
                      .run = grow,
                      .hand = hand_layers,
                      .given = run};
  cw_progress_start(run->context.log, "layers", faces, "wall faces");
  CW_TRY(cw_groups_run(&run->context, &work, of_domain));
  *outcome = cw_outcomes_first(run->model.domain_count, of_domain);
  if (outcome->kind == CW_OUTCOME_DONE) cw_progress(run->context.log, faces);
  cw_progress_end(run->context.log);
  if (outcome->kind != CW_OUTCOME_DONE) goto done;
  if (run->rank == 0)
    CW_TRY(cw_record_step(run->record, "layers", cw_seconds() - started, run->model.domain_count, "domains"));
done:
  return status;
}
