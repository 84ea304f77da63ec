// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/run_walls.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/network/network_audit.h"
#include "mesher/parallel/profiler.h"
#include "mesher/run/cell_count.h"
#include "mesher/run/mesh_steps.h"
#include "mesher/run/run_layers.h"
#include "mesher/run/run_step.h"
#include "mesher/run/stage_view.h"
#include "mesher/thickness/coupled_edges.h"
#include "pipeline/log.h"

enum { WALL_PASSES = 3 };
// Of the asked number of cells, that walls may be off. In fine meshes, at scales up to 1, tetrahedra make up for it; in
// coarse ones most of these stand on the walls, and there are as many as wall triangles ask.
static const double TOLERANCE_FINE = 0.03, TOLERANCE_COARSE = 0.01;

static double tolerance(const CwMeshRun *run) {
  return run->scale <= 1 ? TOLERANCE_FINE : TOLERANCE_COARSE;
}

// Boundaries with all wall curves, those along interfaces divided alike on both sides. Outcome: that of
// cw_domain_start.
static CwStatus start_walls(CwMeshRun *run, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->model.domain_count; d++) {
    outcome->domain = d;
    CW_TRY_STAGE(cw_domain_start(&run->context, &run->domain[d], outcome), outcome);
    CW_AUDIT(cw_network_audit(&run->domain[d].network));
  }
  for (int i = 0; i < run->model.interface_count; i++) {
    const CwModelPatch *a = &run->model.patch[run->model.interface[i].patch[0]],
                       *b = &run->model.patch[run->model.interface[i].patch[1]];
    CwDomain *of_a = &run->domain[a->domain], *of_b = &run->domain[b->domain];
    CW_TRY(cw_couple_open_edges(&of_a->input, a->name, &of_a->open_edges, &of_b->input, b->name, &of_b->open_edges));
  }
  for (int d = 0; d < run->model.domain_count; d++) {
    CwDomain *domain = &run->domain[d];
    CW_TRY(cw_wall_curves_make(&run->context, &domain->input, &domain->open_edges, &domain->wall_curves));
    CW_AUDIT(cw_wall_curves_audit(&domain->wall_curves, &domain->network));
  }
done:
  return status;
}

CwStatus cw_run_walls(CwMeshRun *run, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int again = 0; // the same walls, for thinner layers
  CwResults results = {.shared = 1};
  CwMeshTask *task = NULL;
  int32_t count, faces[CW_DOMAINS_MOST];
  for (int d = 0; d < run->model.domain_count; d++) again |= run->most_thickness[d] != NULL;
  if (again) cw_mesh_set_scale(run, run->surface_scale);
  CW_TRY(cw_face_tasks(run, 1, &count, &task));
  cw_face_counts(run, faces);
  for (int pass = 0;; pass++) {
    int64_t triangles = 0;
    cw_profiler_part(&run->context, "curves of the walls");
    CW_TRY(start_walls(run, outcome));
    CW_TRY_STAGE(cw_run_alike(run, &outcome->kind, sizeof outcome->kind), outcome);
    CW_TRY(cw_stage_view(run, CW_STAGE_CURVES));
    if (run->stopped) break;
    CW_TRY(cw_results_make(&results, run->model.domain_count, faces));
    CW_TRY(cw_run_step(run, "surface", "faces", cw_step_wall, count, task, NULL, &results, NULL));
    CW_TRY_STAGE(cw_run_merge_walls(run, &results, outcome), outcome);
    for (int d = 0; d < run->model.domain_count; d++) {
      cw_log_debug(run->context.log, "%s: graded columns take %.3f of the volume of full ones", run->domain[d].name,
                   run->domain[d].layer_share);
      triangles += run->domain[d].surface.triangle_count;
    }
    cw_results_free(&results);
    cw_learn_prisms(run);
    double off = cw_predicted_off(run);
    cw_log(run->context.log, "surface: %lld wall triangles at scale %.4f; %.2f %% off the asked count as predicted",
           (long long)triangles, run->scale, 100 * off);
    if (again || fabs(off) <= tolerance(run) || pass + 1 == WALL_PASSES) break;
    cw_mesh_solve_scale(run);
  }
  if (run->stopped) goto done;
  run->surface_scale = run->scale;
  if (run->scale <= 1 && fabs(cw_predicted_off(run)) <= TOLERANCE_FINE) cw_mesh_fit_volume(run);
done:
  cw_results_free(&results);
  free(task);
  return status;
}
