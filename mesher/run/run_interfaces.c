// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_interfaces.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/profiler.h"
#include "mesher/run/mesh_steps.h"
#include "mesher/run/run_step.h"
#include "pipeline/log.h"

CwStatus cw_run_interfaces(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwResults results = {0}; // of each domain first those of its faces
  CwMeshTask *open_patch = NULL, *task = NULL;
  int32_t open_patches, count, faces[CW_DOMAINS_MOST], parts[CW_DOMAINS_MOST];
  cw_profiler_part(&run->context, "free curves");
  for (int d = 0; d < run->model.domain_count; d++) {
    CwDomain *domain = &run->domain[d];
    CwOutcome of_domain = {.domain = d};
    CW_TRY(cw_free_curves_make(&domain->input, &domain->wall_curves, &domain->surface, &domain->layers,
                               &domain->free_curves, &of_domain));
    if (of_domain.kind == CW_OUTCOME_THIN) CW_TRY(cw_thin_places_on_planes(run, &of_domain, places));
    if (of_domain.kind == CW_OUTCOME_DONE) {
      CW_AUDIT(cw_free_curves_audit(&domain->free_curves, &domain->network));
      continue;
    }
    *outcome = of_domain;
    if (outcome->kind == CW_OUTCOME_ASYMMETRIC) goto done;
  }
  if (outcome->kind != CW_OUTCOME_DONE) goto done;
  cw_face_counts(run, faces);
  CW_TRY(cw_face_tasks(run, 0, &open_patches, &open_patch));
  count = open_patches;
  for (int d = 0; d < run->model.domain_count; d++) {
    parts[d] = faces[d] + run->domain[d].free_curves.outline_count;
    count += run->domain[d].free_curves.outline_count;
  }
  CW_TRY(cw_results_make(&results, run->model.domain_count, parts));
  CW_NEW(task, count);
  memcpy(task, open_patch, (size_t)open_patches * sizeof *task);
  count = open_patches;
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    for (int32_t i = 0; i < domain->free_curves.outline_count; i++) {
      if (cw_image_turns(&domain->images, &domain->free_curves.outline_images, i) > 0) continue;
      // Takes about as long as an open patch of as many triangles.
      task[count++] = (CwMeshTask){d, faces[d] + i, domain->free_curves.outline[i].corner_count};
    }
  }
  CW_TRY(cw_run_step(run, "inner surfaces", "surfaces", cw_step_inner, count, task, NULL, results.bytes, NULL));
  cw_profiler_part(&run->context, "inner surfaces merged");
  for (int d = 0; d < run->model.domain_count; d++) {
    CW_TRY(cw_interfaces_make(&run->domain[d].input, &run->domain[d].free_curves, results.bytes[d],
                              results.bytes[d] + faces[d], &run->domain[d].interfaces, outcome));
    outcome->domain = d;
    if (outcome->kind != CW_OUTCOME_DONE) goto done;
    CW_AUDIT(cw_interfaces_audit(&run->domain[d].interfaces, run->domain[d].plan.region_count));
    CW_TRY(cw_domain_number(&run->domain[d]));
  }
done:
  cw_results_free(&results);
  free(open_patch);
  free(task);
  return status;
}

CwStatus cw_run_region_rule(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwResults results = {0};
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
  CW_TRY(cw_run_step(run, "region rule", "regions", cw_step_rule, count, task, NULL, results.bytes, NULL));
  cw_profiler_part(&run->context, "interfaces merged");
  for (int d = 0; d < run->model.domain_count; d++) {
    CwDomain *domain = &run->domain[d];
    CW_TRY(cw_interface_rule_merge(&domain->images, &domain->interfaces, domain->plan.region_count, results.bytes[d],
                                   &domain->rule));
    CW_AUDIT(cw_interfaces_audit(&domain->interfaces, domain->plan.region_count));
    if (domain->rule.planned == 0) continue;
    cw_log(run->context.log,
           "%s: region numbers in %d colours; of %lld interface triangles, with new points in their spheres %lld, "
           "centres inserted %lld, triangles left to both sides %lld",
           domain->name, domain->colours, (long long)domain->rule.planned, (long long)domain->rule.encroached,
           (long long)domain->rule.inserted, (long long)domain->rule.left);
  }
done:
  cw_results_free(&results);
  free(task);
  return status;
}
