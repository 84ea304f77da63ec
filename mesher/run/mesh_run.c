// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/mesh_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesher/parallel/profiler.h"
#include "mesher/policy.h"
#include "mesher/run/cell_count.h"
#include "mesher/run/manifest.h"
#include "mesher/run/mesh_plan.h"
#include "mesher/run/pass_state.h"
#include "mesher/run/run_interfaces.h"
#include "mesher/run/run_layers.h"
#include "mesher/run/run_regions.h"
#include "mesher/run/run_thinning.h"
#include "mesher/run/run_walls.h"
#include "mesher/run/stage_view.h"
#include "pipeline/atomic_file.h"
#include "pipeline/log.h"

enum { PASSES_MOST = 4, MENDS_MOST = 6 };
static const double COUNT_TOLERANCE = 0.02; // of the asked number of cells

// The stages of one attempt, in their order. After the one that the run is to end with it is done.
static CwStatus mesh_attempt(CwMeshRun *run, CwThinPlaces *places, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CW_TRY_STAGE(cw_run_walls(run, outcome), outcome);
  CW_TRY(cw_stage_view(run, CW_STAGE_SURFACE));
  if (run->stopped) goto done;
  CW_TRY_STAGE(cw_run_layers(run, outcome), outcome);
  CW_TRY(cw_stage_view(run, CW_STAGE_LAYERS));
  if (run->stopped) goto done;
  CW_TRY_STAGE(cw_run_interfaces(run, places, outcome), outcome);
  CW_TRY(cw_run_region_rule(run));
  CW_TRY(cw_stage_view(run, CW_STAGE_INTERFACES));
  if (run->stopped) goto done;
  CW_TRY(cw_run_regions(run, places, outcome));
done:
  return status;
}

static int count_is_met(const CwMeshRun *run) {
  return fabs((double)run->cells / (double)run->table->mesh.cells - 1) <= COUNT_TOLERANCE;
}

// Thins the layers about flat tetrahedra of a mesh that has as many cells as asked, as long as these become fewer or
// less flat: between layers that leave little room no filling is better. What does not help is taken back.
static CwStatus mend_flat(CwMeshRun *run, CwThinPlaces *places) {
  CwStatus status = CW_OK;
  double *kept[CW_DOMAINS_MOST] = {0}, deficit, left;
  for (int attempt = 0; attempt < MENDS_MOST && count_is_met(run); attempt++) {
    CwOutcome outcome = {0};
    CwThinPlaces after = {0};
    places->count = 0;
    CW_TRY(cw_thin_places_flat(run, places, &deficit));
    if (places->count == 0) break;
    cw_log(run->context.log, "%d regions have tetrahedra below %.0f degrees; made again with thinner layers there",
           places->count, cw_policy.flat_angle);
    CW_TRY(cw_thinning_copy(run, kept));
    CW_TRY(cw_thin_flat(run, places));
    CW_TRY(mesh_attempt(run, places, &outcome));
    if (outcome.kind == CW_OUTCOME_DONE) CW_TRY(cw_thin_places_flat(run, &after, &left));
    cw_thin_places_free(&after);
    if (outcome.kind == CW_OUTCOME_DONE && count_is_met(run) && left < deficit) continue;
    cw_thinning_take_back(run, kept);
    outcome = (CwOutcome){0};
    CW_TRY(mesh_attempt(run, places, &outcome));
    break;
  }
done:
  for (int d = 0; d < CW_DOMAINS_MOST; d++) free(kept[d]);
  return status;
}

// One pass at the present scale. Where equal passages do not come out equal, the impeller is meshed whole; a domain
// with a plane that grazes a wall, or on which no column leaves one, gets other planes; surfaces and regions that fail
// are tried again with thinner layers, and with other planes where these do not do.
static CwStatus mesh_pass(CwMeshRun *run) {
  CwStatus status = CW_OK;
  CwThinPlaces places = {0};
  for (int attempt = 0;;) {
    CwOutcome outcome = {0};
    places.count = 0;
    CW_TRY(mesh_attempt(run, &places, &outcome));
    if (outcome.kind == CW_OUTCOME_DONE) break;
    if (outcome.kind == CW_OUTCOME_THIN) {
      outcome = (CwOutcome){0};
      CW_TRY(cw_thin(run, &places, attempt++, &outcome));
      if (outcome.kind == CW_OUTCOME_DONE) continue;
    }
    attempt = 0;
    cw_end_thinning(run); // the walls will be others
    CW_TRY(cw_mesh_plan_again(run, &outcome));
  }
  if (!run->stopped) CW_TRY(mend_flat(run, &places));
done:
  cw_thin_places_free(&places);
  cw_end_thinning(run);
  return status;
}

static double rounded(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.12g", value);
  return strtod(text, NULL);
}

static CwCellLaw rounded_law(const CwCellLaw *law) {
  return (CwCellLaw){rounded(law->factor), rounded(law->scale), rounded(law->exponent)};
}

CwStatus cw_mesh_run(CwMeshRun *run) {
  CwStatus status = CW_OK;
  char path[4096], fingerprint[CW_HASH_TEXT];
  snprintf(path, sizeof path, "%s/mesh", run->run_path);
  CW_TRY(cw_make_directory(path));
  CW_TRY(cw_mesh_open(run));
  double asked = (double)run->table->mesh.cells;
  cw_start_factors(run);
  CwPassState state = {.pass = 1};
  CW_TRY(cw_pass_fingerprint(run->table, run->run_path, &run->model, fingerprint));
  cw_pass_state_read(run->context.log, run->run_path, fingerprint, &state);
  for (int d = 0; d < run->model.domain_count; d++) run->domain[d].more_regions = state.more_regions[d];
  CW_TRY(cw_stage_view(run, CW_STAGE_SIZE));
  if (run->stopped) goto done;
  CW_TRY(cw_mesh_plan(run));
  CW_TRY(cw_stage_view(run, CW_STAGE_DECOMPOSITION));
  if (run->stopped) goto done;
  if (state.pass > 1) {
    run->prisms = state.prisms;
    run->tets = state.tets;
    cw_mesh_solve_scale(run);
    cw_log(run->context.log, "going on with pass %d of an earlier run", state.pass);
    if (state.whole) CW_TRY(cw_mesh_plan_whole(run, "as in the run that this one goes on from"));
  }
  for (run->passes = state.pass;; run->passes++) {
    CW_TRY(mesh_pass(run));
    if (run->stopped) goto done;
    double off = (double)run->cells / asked - 1;
    cw_log(run->context.log, "pass %d: %lld cells, %.2f %% off the asked %.0f", run->passes, (long long)run->cells,
           100 * off, asked);
    cw_learn_tets(run);
    if (count_is_met(run)) break;
    if (run->passes == PASSES_MOST) {
      cw_log_warn(run->context.log, "%lld cells made, %.1f %% off the asked %.0f after %d passes",
                  (long long)run->cells, 100 * off, asked, run->passes);
      break;
    }
    // As many digits as the file keeps, so that a run that goes on from it has the same bits.
    run->prisms = rounded_law(&run->prisms);
    run->tets = rounded_law(&run->tets);
    state = (CwPassState){run->passes + 1, run->prisms, run->tets, run->whole, {0}};
    for (int d = 0; d < run->model.domain_count; d++) state.more_regions[d] = run->domain[d].more_regions;
    if (run->rank == 0) CW_TRY(cw_pass_state_write(run->run_path, fingerprint, &state));
    for (int d = 0; d < run->model.domain_count; d++) run->domain[d].layer_share = CW_LAYER_SHARE;
    cw_mesh_solve_scale(run);
  }
  cw_profiler_part(&run->context, "manifest");
  if (run->rank == 0) CW_TRY(cw_mesh_manifest(run));
done:
  return status;
}

void cw_mesh_run_free(CwMeshRun *run) {
  json_decref(run->headlines);
  for (int d = 0; d < run->model.domain_count; d++) {
    cw_domain_close(&run->domain[d]);
    free(run->summary[d]);
    free(run->region_seconds[d]);
  }
}
