// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_regions.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/profiler.h"
#include "mesher/run/mesh_steps.h"
#include "mesher/run/run_step.h"
#include "pipeline/log.h"

static const double COPY_COST = 0.07; // of a periodic image of a region, by that of its first

// The summaries of a region and of its periodic images.
static void take_summaries(CwMeshRun *run, int d, int32_t region, const CwRegionSummary *made) {
  const CwDomain *domain = &run->domain[d];
  int32_t copies = cw_region_copies(domain, region);
  for (int32_t turns = 0; turns < copies; turns++) {
    int32_t copy = cw_image_region(&domain->images, &domain->plan, region, turns);
    run->summary[d][copy] = *made;
    run->cells += (int64_t)made->tetrahedra + made->pyramids + made->prisms;
  }
}

static int has_failed(const void *summary) {
  return ((const CwRegionSummary *)summary)->failure.failed;
}

CwStatus cw_run_regions(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwResults results = {.in_vain = has_failed};
  CwMeshTask *task = NULL;
  uint64_t open_faces[CW_DOMAINS_MOST] = {0};
  int32_t regions[CW_DOMAINS_MOST], all = 0, count = 0, *after = NULL;
  cw_profiler_part(&run->context, "points that regions share");
  for (int d = 0; d < run->model.domain_count; d++)
    CW_TRY(cw_domain_share(run->context.log, &run->domain[d], run->table));
  for (int d = 0; d < run->model.domain_count; d++) {
    regions[d] = run->domain[d].plan.region_count;
    all += regions[d];
    free(run->summary[d]);
    free(run->region_seconds[d]);
    run->summary[d] = NULL;
    run->region_seconds[d] = NULL;
    CW_NEW(run->summary[d], regions[d]);
    CW_NEW(run->region_seconds[d], regions[d]);
  }
  CW_NEW(task, all);
  CW_NEW(after, all);
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    for (int32_t r = 0; r < regions[d]; r++) {
      if (cw_image_region_first(&domain->images, &domain->plan, r) != r) continue;
      int32_t first = count, copies = cw_region_copies(domain, r);
      double cost = run->domain[d].plan.predicted_cells[r];
      after[count] = -1;
      task[count++] = (CwMeshTask){d, r, cost};
      for (int32_t turns = 1; turns < copies; turns++) {
        after[count] = first;
        task[count++] = (CwMeshTask){d, cw_image_region(&domain->images, &domain->plan, r, turns), COPY_COST * cost};
      }
    }
  }
  CW_TRY(cw_results_make(&results, run->model.domain_count, regions));
  CW_TRY(cw_run_step(run, "regions", "regions", cw_step_region, count, task, after, &results, run->region_seconds));
  cw_profiler_part(&run->context, "results");
  run->cells = 0;
  for (int32_t i = 0; i < count; i++) {
    const CwRegionSummary *made = results.bytes[task[i].domain][task[i].index];
    if (!made) continue; // the copy of one that has failed
    if (after[i] < 0) take_summaries(run, task[i].domain, task[i].index, made);
    strcpy(run->summary[task[i].domain][task[i].index].digest, made->digest); // each copy its own
    if (made->damage[0] && run->rank == 0) cw_log_warn(run->context.log, "%s; it is made again", made->damage);
    open_faces[task[i].domain] += made->quality.open_faces;
    if (made->failure.failed) outcome->kind = CW_OUTCOME_THIN;
  }
  if (outcome->kind == CW_OUTCOME_THIN) CW_TRY_STAGE(cw_thin_places_in_regions(run, places), outcome);
  for (int d = 0; d < run->model.domain_count; d++) {
    CW_REQUIRE(open_faces[d] == 0, CW_ERR_MESH,
               "%s: its %d regions in %s/mesh do not fit together on the partition planes; allowed: each face there in "
               "two of them; remove that folder and run cutwater-mesh again",
               run->domain[d].name, regions[d], run->run_path);
  }
done:
  cw_results_free(&results);
  free(after);
  free(task);
  return status;
}
