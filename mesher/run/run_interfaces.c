// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_interfaces.h"

#include <stdlib.h>

#include "mesher/parallel/profiler.h"
#include "mesher/run/mesh_steps.h"
#include "mesher/run/run_step.h"
#include "pipeline/log.h"

static CwStatus make_curves(void *given, const CwContext *context, int32_t d, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwDomain *domain = &((const CwMerging *)given)->run->domain[d];
  cw_profiler_part(context, "free curves");
  CW_TRY(cw_free_curves_make(&domain->input, &domain->wall_curves, &domain->surface, &domain->layers,
                             &domain->free_curves, outcome));
  if (outcome->kind == CW_OUTCOME_DONE) CW_AUDIT(cw_free_curves_audit(&domain->free_curves, &domain->network));
done:
  return status;
}

static CwStatus hand_curves(void *given, const CwGroupHand *hand) {
  CwFreeCurves *curves = &((const CwMerging *)given)->run->domain[hand->item].free_curves;
  return cw_group_hold(hand, curves, sizeof *curves, cw_free_curves_arrays, &curves->memory);
}

// Outcome: CW_OUTCOME_ASYMMETRIC before CW_OUTCOME_THIN, with the places of all domains.
static CwStatus run_curves(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  static const CwDomainWork work = {
      .step = "free curves", .own = 1, .copied = 1, .work = make_curves, .hand = hand_curves};
  CwOutcome of_domain[CW_DOMAINS_MOST];
  CW_TRY(cw_run_domains(run, &work, NULL, of_domain));
  for (int d = 0; d < run->model.domain_count; d++) {
    of_domain[d].domain = d;
    if (of_domain[d].kind == CW_OUTCOME_THIN) CW_TRY(cw_thin_places_on_planes(run, &of_domain[d], places));
    if (of_domain[d].kind != CW_OUTCOME_DONE) *outcome = of_domain[d];
    if (outcome->kind == CW_OUTCOME_ASYMMETRIC) break;
  }
done:
  return status;
}

static CwStatus merge_interfaces(void *given, const CwContext *context, int32_t d, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwMerging *merging = given;
  CwDomain *domain = &merging->run->domain[d];
  void **bytes = merging->results->bytes[d];
  cw_profiler_part(context, "interfaces merged");
  CW_TRY_STAGE(cw_interfaces_make(&domain->input, &domain->free_curves, bytes, bytes + cw_cad_face_count(domain->cad),
                                  &domain->interfaces, outcome),
               outcome);
  CW_AUDIT(cw_interfaces_audit(&domain->interfaces, domain->plan.region_count));
done:
  return status;
}

static CwStatus hand_interfaces(void *given, const CwGroupHand *hand) {
  CwDomain *domain = &((const CwMerging *)given)->run->domain[hand->item];
  CwInterfaces *interfaces = &domain->interfaces;
  if (!hand->mine) cw_free_curves_free(&domain->free_curves);
  return cw_group_hold(hand, interfaces, sizeof *interfaces, cw_interfaces_arrays, &interfaces->memory);
}

CwStatus cw_run_interfaces(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  static const CwDomainWork work = {
      .step = "interfaces merged", .own = 1, .copied = 1, .work = merge_interfaces, .hand = hand_interfaces};
  CwOutcome of_domain[CW_DOMAINS_MOST];
  CwResults results = {.shared = 1}; // of each domain first those of its faces
  CwMeshTask *task = NULL;
  int32_t count, capacity, faces[CW_DOMAINS_MOST], parts[CW_DOMAINS_MOST];
  CW_TRY_STAGE(run_curves(run, places, outcome), outcome);
  cw_face_counts(run, faces);
  CW_TRY(cw_face_tasks(run, 0, &count, &task));
  capacity = count;
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    parts[d] = faces[d] + domain->free_curves.outline_count;
    CW_GROW(task, capacity, count + domain->free_curves.outline_count);
    for (int32_t i = 0; i < domain->free_curves.outline_count; i++) {
      if (cw_image_turns(&domain->images, &domain->free_curves.outline_images, i) > 0) continue;
      // Takes about as long as an open patch of as many triangles.
      task[count++] = (CwMeshTask){d, faces[d] + i, domain->free_curves.outline[i].corner_count};
    }
  }
  CW_TRY(cw_results_make(&results, run->model.domain_count, parts));
  CW_TRY(cw_run_step(run, "interfaces", "surfaces", cw_step_interface, count, task, NULL, &results, NULL));
  CW_TRY(cw_run_domains(run, &work, &results, of_domain));
  *outcome = cw_outcomes_first(run->model.domain_count, of_domain);
  for (int d = 0; outcome->kind == CW_OUTCOME_DONE && d < run->model.domain_count; d++)
    CW_TRY(cw_domain_number(&run->domain[d]));
done:
  cw_results_free(&results);
  free(task);
  return status;
}

static CwStatus merge_rule(void *given, const CwContext *context, int32_t d, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwMerging *merging = given;
  CwDomain *domain = &merging->run->domain[d];
  cw_profiler_part(context, "region rule merged");
  CW_TRY(cw_interface_rule_merge(&domain->images, &domain->interfaces, domain->plan.region_count,
                                 merging->results->bytes[d], &domain->rule));
  CW_AUDIT(cw_interfaces_audit(&domain->interfaces, domain->plan.region_count));
  const CwRegionInput from = cw_domain_region_input(domain, context->log);
  CW_TRY(cw_shared_nodes_make(&from, domain->layer_count, &domain->shared));
done:
  return status;
}

static CwStatus hand_rule(void *given, const CwGroupHand *hand) {
  CwStatus status = CW_OK;
  CwDomain *domain = &((const CwMerging *)given)->run->domain[hand->item];
  CwInterfaces *interfaces = &domain->interfaces;
  CwSharedNodes *shared = &domain->shared;
  if (!hand->mine) cw_interfaces_free(interfaces);
  CW_TRY(cw_group_hold(hand, interfaces, sizeof *interfaces, cw_interfaces_arrays, &interfaces->memory));
  CW_TRY(cw_group_hold(hand, shared, sizeof *shared, cw_shared_nodes_arrays, &shared->memory));
  cw_group_give(hand, &domain->rule, sizeof domain->rule);
done:
  return status;
}

static void log_rule(CwLog *log, const CwDomain *domain) {
  if (domain->rule.planned == 0) return;
  cw_log(log,
         "%s: region numbers in %d colours; of %lld interface triangles, with new points in their spheres %lld, "
         "centres inserted %lld, triangles left to both sides %lld",
         domain->name, domain->colours, (long long)domain->rule.planned, (long long)domain->rule.encroached,
         (long long)domain->rule.inserted, (long long)domain->rule.left);
}

CwStatus cw_run_region_rule(CwMeshRun *run) {
  CwStatus status = CW_OK;
  static const CwDomainWork work = {
      .step = "region rule merged", .own = 1, .copied = 1, .work = merge_rule, .hand = hand_rule};
  CwOutcome of_domain[CW_DOMAINS_MOST]; // all done
  CwResults results = {.shared = 1};
  CwMeshTask *task = NULL;
  int32_t regions[CW_DOMAINS_MOST], all = 0, count = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    regions[d] = run->domain[d].plan.region_count;
    all += regions[d];
  }
  CW_NEW(task, all);
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    const CwRegionInput from = cw_domain_region_input(domain, run->context.log);
    for (int32_t r = 0; r < regions[d]; r++) {
      int refines = 0;
      for (int32_t i = 0; i < domain->interfaces.outline_count; i++)
        refines |= cw_interface_refiner(&from, domain->number, i) == r;
      if (refines) task[count++] = (CwMeshTask){d, r, domain->plan.predicted_cells[r]};
    }
  }
  CW_TRY(cw_results_make(&results, run->model.domain_count, regions));
  CW_TRY(cw_run_step(run, "region rule", "regions", cw_step_rule, count, task, NULL, &results, NULL));
  CW_TRY(cw_run_domains(run, &work, &results, of_domain));
  for (int d = 0; d < run->model.domain_count; d++) log_rule(run->context.log, &run->domain[d]);
done:
  cw_results_free(&results);
  free(task);
  return status;
}
