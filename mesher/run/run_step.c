// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_step.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/schedule.h"
#include "pipeline/hash.h"
#include "pipeline/log.h"

typedef struct {
  CwMeshRun *run;
  const CwMeshTask *task;
  CwMeshStep step;
} StepContext;

// The status of work on a domain, whose name a failure tells.
static CwStatus in_domain(const CwMeshRun *run, int32_t domain, CwStatus status) {
  if (status == CW_ERR_GEOMETRY || status == CW_ERR_MESH || status == CW_ERR_LIBRARY || status == CW_ERR_FAULT)
    cw_fail_place(run->domain[domain].name);
  return status;
}

static CwStatus run_one(void *context, int32_t index, void **bytes, int64_t *size) {
  StepContext *step = context;
  CwMeshTask task = step->task[index];
  return in_domain(step->run, task.domain, step->step(step->run, task, bytes, size));
}

CwStatus cw_run_alike(const CwMeshRun *run, const void *also, size_t size) {
  CwHash hash = cw_hash_start();
  const double scales[] = {run->scale, run->gradation, run->wall_scale};
  const CwCellLaw laws[] = {run->prisms, run->tets};
  cw_hash_bytes(&hash, scales, sizeof scales);
  cw_hash_bytes(&hash, laws, sizeof laws);
  for (int p = 0; p < run->model.patch_count; p++) {
    const CwModelPatch *patch = &run->model.patch[p];
    const CwDomain *domain = &run->domain[patch->domain];
    cw_hash_bytes(&hash, &domain->patch_layers[patch - domain->patch], sizeof *domain->patch_layers);
  }
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    for (int32_t n = 0; n < domain->plan.node_count; n++)
      cw_hash_bytes(&hash, &domain->plan.node[n].plane, sizeof domain->plan.node[n].plane);
    cw_hash_bytes(&hash, domain->wall_curves.x,
                  (size_t)domain->wall_curves.vertex_count * sizeof *domain->wall_curves.x);
  }
  cw_hash_bytes(&hash, also, size);
  return cw_team_alike(run->context.team, "sizes, planes or curves", hash.sum[0] ^ hash.sum[1]);
}

CwStatus cw_run_step(CwMeshRun *run, const char *name, const char *unit, CwMeshStep body, int32_t count,
                     const CwMeshTask *task, const int32_t *after, CwResults *results, double **seconds) {
  CwStatus status = CW_OK;
  void **result = NULL;
  int64_t *size = NULL;
  double *cost = NULL, *time = NULL, started = cw_seconds();
  StepContext context = {run, task, body};
  CW_TRY(cw_run_alike(run, task, (size_t)count * sizeof *task));
  CW_NEW(result, count);
  CW_NEW(size, count);
  CW_NEW(cost, count);
  CW_NEW(time, count);
  for (int32_t i = 0; i < count; i++) cost[i] = task[i].cost;
  CwSchedule schedule = {.step = name,
                         .unit = unit,
                         .count = count,
                         .cost = cost,
                         .after = after,
                         .in_vain = results->in_vain,
                         .run = run_one,
                         .context = &context,
                         .gather = 1,
                         .held = results->shared ? &results->memory : NULL};
  CW_TRY(cw_schedule_run(&run->context, &schedule, result, size, time));
  for (int32_t i = 0; i < count; i++) {
    results->bytes[task[i].domain][task[i].index] = result[i];
    result[i] = NULL;
    if (seconds) seconds[task[i].domain][task[i].index] = time[i];
  }
  if (run->rank == 0) CW_TRY(cw_record_step(run->record, name, cw_seconds() - started, count, unit));
done:
  if (result) {
    for (int32_t i = 0; i < count; i++) free(result[i]);
  }
  free(result);
  free(size);
  free(cost);
  free(time);
  return status;
}

static void tell_of_copies(CwMeshRun *run) {
  if (run->copies_told || run->rank != 0 || !cw_host_memory_refusal()) return;
  cw_log_warn(run->context.log,
              "the system shares no memory between the ranks (%s): each holds surfaces and layers for itself; allow "
              "System V shared memory (kernel.shmmax, kernel.shmall, one IPC namespace a host), or ask for fewer ranks",
              strerror(cw_host_memory_refusal()));
  run->copies_told = 1;
}

static CwStatus run_domain(void *given, const CwContext *context, int32_t domain, CwOutcome *outcome) {
  const CwMerging *merging = given;
  return in_domain(merging->run, domain, merging->of->work(given, context, domain, outcome));
}

CwStatus cw_run_domains(CwMeshRun *run, const CwDomainWork *of, const CwResults *results,
                        CwOutcome outcome[CW_DOMAINS_MOST]) {
  CwStatus status = CW_OK;
  double cost[CW_DOMAINS_MOST];
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    double made = domain->symmetry ? 1.0 / domain->symmetry->count : 1;
    cost[d] = domain->prism_integral * (made + of->copied * (1 - made));
  }
  CwGroupWork work = {.step = of->step,
                      .count = run->model.domain_count,
                      .cost = cost,
                      .own = of->own,
                      .by_threads = 1,
                      .run = run_domain,
                      .hand = of->hand,
                      .given = &(CwMerging){run, results, of}};
  CW_TRY(cw_groups_run(&run->context, &work, outcome));
  tell_of_copies(run);
done:
  return status;
}

CwStatus cw_results_make(CwResults *results, int domains, const int32_t *count) {
  CwStatus status = CW_OK;
  for (int d = 0; d < domains; d++) {
    results->count[d] = count[d];
    CW_NEW(results->bytes[d], results->count[d]);
  }
done:
  return status;
}

void cw_results_free(CwResults *results) {
  for (int d = 0; d < CW_DOMAINS_MOST; d++) {
    for (int32_t i = 0; results->bytes[d] && !results->memory && i < results->count[d]; i++) free(results->bytes[d][i]);
    free(results->bytes[d]);
    results->bytes[d] = NULL;
  }
  cw_host_memory_free(&results->memory);
}

CwHostMemory *cw_results_keep(CwResults *results) {
  CwHostMemory *memory = results->memory;
  results->memory = NULL;
  for (int d = 0; memory && d < CW_DOMAINS_MOST; d++) {
    free(results->bytes[d]);
    results->bytes[d] = NULL;
  }
  cw_results_free(results);
  return memory;
}

void cw_face_counts(const CwMeshRun *run, int32_t count[CW_DOMAINS_MOST]) {
  for (int d = 0; d < run->model.domain_count; d++) count[d] = cw_cad_face_count(run->domain[d].cad);
}

CwStatus cw_face_tasks(const CwMeshRun *run, int walls, int32_t *count, CwMeshTask **tasks) {
  CwStatus status = CW_OK;
  int32_t faces[CW_DOMAINS_MOST], all = 0;
  *count = 0;
  cw_face_counts(run, faces);
  for (int d = 0; d < run->model.domain_count; d++) all += faces[d];
  CW_NEW(*tasks, all);
  for (int d = 0; d < run->model.domain_count; d++) {
    const CwDomain *domain = &run->domain[d];
    for (int32_t f = 0; f < cw_cad_face_count(domain->cad); f++) {
      if (cw_cad_face_is_wall(domain->cad, f) != walls || cw_cad_face_is_left_out(domain->cad, f)) continue;
      if (domain->symmetry && domain->symmetry->face.first[f] != f) continue;
      (*tasks)[(*count)++] = (CwMeshTask){d, f, domain->face_triangles[f]};
    }
  }
done:
  return status;
}
