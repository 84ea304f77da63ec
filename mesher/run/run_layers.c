// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_layers.h"

#include <math.h>

#include "mesher/common/give_back.h"
#include "mesher/parallel/groups.h"
#include "mesher/parallel/profiler.h"
#include "mesher/thickness/even_columns.h"
#include "mesher/thickness/layer_thickness.h"
#include "pipeline/log.h"

static CwStatus merge(void *given, const CwContext *context, int32_t d, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwMerging *walls = given;
  CwDomain *domain = &walls->run->domain[d];
  const double *most = walls->run->most_thickness[d];
  cw_profiler_part(context, "walls merged");
  CW_TRY_STAGE(cw_surface_mesh_make(context, &domain->input, &domain->wall_curves, walls->results->bytes[d],
                                    &domain->surface, outcome),
               outcome);
  CW_AUDIT(cw_surface_mesh_audit(&domain->surface, domain->plan.region_count));
  CW_TRY(cw_domain_targets(context, domain));
  for (int32_t v = 0; most && v < domain->surface.vertex_count; v++)
    domain->targets.target[v] = fmin(domain->targets.target[v], most[v]);
done:
  return status;
}

static CwStatus hand_walls(void *given, const CwGroupHand *hand) {
  CwStatus status = CW_OK;
  CwDomain *domain = &((const CwMerging *)given)->run->domain[hand->item];
  CwSurfaceMesh *surface = &domain->surface;
  CwColumnTargets *targets = &domain->targets;
  CW_TRY(cw_group_hold(hand, surface, sizeof *surface, cw_surface_mesh_arrays, &surface->memory));
  CW_TRY(cw_group_hold(hand, targets, sizeof *targets, cw_column_targets_arrays, &targets->memory));
  cw_group_give(hand, &domain->layer_share, sizeof domain->layer_share);
done:
  return status;
}

CwStatus cw_run_merge_walls(CwMeshRun *run, const CwResults *results, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  static const CwDomainWork work = {
      .step = "walls merged", .own = 0.4, .copied = 0.75, .work = merge, .hand = hand_walls};
  CwOutcome of_domain[CW_DOMAINS_MOST];
  CW_TRY(cw_run_domains(run, &work, results, of_domain));
  *outcome = cw_outcomes_first(run->model.domain_count, of_domain);
done:
  return status;
}

// Share of the column over a vertex that its last layer takes where it is so high.
static double last_layer(const void *context, int32_t vertex, double thickness) {
  const CwColumnTargets *targets = context;
  return cw_layer_last(thickness, targets->first_height[vertex], targets->layer_count, targets->growth[vertex]);
}

static CwStatus grow(void *given, const CwContext *context, int32_t d, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwDomain *domain = &((const CwMerging *)given)->run->domain[d];
  CwLayerDivision division = {domain->layer_count, last_layer, &domain->targets};
  CW_TRY_STAGE(cw_boundary_grow(context, &domain->input, &domain->wall_curves, &domain->surface, &domain->background,
                                domain->targets.target, domain->targets.least, &division, &domain->layers, outcome),
               outcome);
  CW_AUDIT(cw_layers_audit(&domain->layers, (const double(*)[3])domain->surface.x));
  cw_profiler_part(context, "layers: small prisms");
  CW_TRY(cw_columns_divide(context, &domain->targets, &domain->surface, &domain->layers));
done:
  return status;
}

static CwStatus hand_layers(void *given, const CwGroupHand *hand) {
  CwLayers *layers = &((const CwMerging *)given)->run->domain[hand->item].layers;
  return cw_group_hold(hand, layers, sizeof *layers, cw_layers_arrays, &layers->memory);
}

CwStatus cw_run_layers(CwMeshRun *run, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  static const CwDomainWork work = {.step = "layers", .own = 0.1, .copied = 0.5, .work = grow, .hand = hand_layers};
  CwOutcome of_domain[CW_DOMAINS_MOST];
  double started = cw_seconds();
  int64_t faces = 0;
  for (int d = 0; d < run->model.domain_count; d++) faces += run->domain[d].surface.triangle_count;
  cw_progress_start(run->context.log, "layers", faces, "wall faces");
  CW_TRY(cw_run_domains(run, &work, NULL, of_domain));
  *outcome = cw_outcomes_first(run->model.domain_count, of_domain);
  if (outcome->kind == CW_OUTCOME_DONE) cw_progress(run->context.log, faces);
  cw_progress_end(run->context.log);
  cw_give_back(); // the columns' work is the most that a rank ever holds
  if (outcome->kind != CW_OUTCOME_DONE) goto done;
  if (run->rank == 0)
    CW_TRY(cw_record_step(run->record, "layers", cw_seconds() - started, run->model.domain_count, "domains"));
done:
  return status;
}
