// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/mesh_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "mesher/common/model_unit.h"
#include "mesher/parallel/profiler.h"
#include "mesher/policy.h"
#include "mesher/run/cell_count.h"
#include "mesher/run/flat_places.h"
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

// Passes, and rounds of shorter edges for layers and for flat tetrahedra.
enum { PASSES_MOST = 4, FINER_MOST = 6, FLAT_MOST = 4 };
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

// One pass at the present scale. Where equal passages do not come out equal, the impeller is meshed whole; a domain
// with a plane that grazes a wall, or on which no column leaves one, gets other planes; surfaces and regions that fail
// are tried again with thinner layers, and with other planes where these do not do. Outcome: CW_OUTCOME_FINER where
// no layers stand.
static CwStatus mesh_pass(CwMeshRun *run, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwThinPlaces places = {0};
  for (int attempt = 0;;) {
    *outcome = (CwOutcome){0};
    places.count = 0;
    CW_TRY(mesh_attempt(run, &places, outcome));
    if (outcome->kind == CW_OUTCOME_DONE || outcome->kind == CW_OUTCOME_FINER) break;
    if (outcome->kind == CW_OUTCOME_THIN) {
      *outcome = (CwOutcome){0};
      CW_TRY(cw_thin(run, &places, attempt++, outcome));
      if (outcome->kind == CW_OUTCOME_DONE) continue;
    }
    attempt = 0;
    cw_end_thinning(run); // the walls will be others
    CW_TRY(cw_mesh_plan_again(run, outcome));
  }
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

// What a run that goes on from here has to know, with as many digits as the file keeps.
static CwStatus keep_state(CwMeshRun *run, int pass, const char *fingerprint, CwPassState *state) {
  CwStatus status = CW_OK;
  run->prisms = rounded_law(&run->prisms);
  run->tets = rounded_law(&run->tets);
  state->pass = pass;
  state->prisms = run->prisms;
  state->tets = run->tets;
  state->whole = run->whole;
  state->finer = run->finer;
  for (int d = 0; d < run->model.domain_count; d++) state->more_regions[d] = run->domain[d].more_regions;
  if (run->rank == 0) CW_TRY(cw_pass_state_write(run->run_path, fingerprint, state));
done:
  return status;
}

// From the size fields to the plan, then the factors and the scale of the state. `again`: the fields are not those that
// the run has opened with.
static CwStatus begin(CwMeshRun *run, const CwPassState *state, int again) {
  CwStatus status = CW_OK;
  if (again) CW_TRY(cw_mesh_resize(run));
  CW_TRY(cw_stage_view(run, CW_STAGE_SIZE));
  if (run->stopped) goto done;
  cw_start_factors(run);
  CW_TRY(cw_mesh_plan(run));
  CW_TRY(cw_stage_view(run, CW_STAGE_DECOMPOSITION));
  if (run->stopped || state->pass == 0) goto done;
  run->prisms = state->prisms;
  run->tets = state->tets;
  cw_mesh_solve_scale(run);
  if (state->whole) CW_TRY(cw_mesh_plan_whole(run, "as in the run that this one goes on from"));
done:
  return status;
}

// Asks for shorter edges where layers do not stand.
static CwStatus shorten_for_layers(CwMeshRun *run, const CwOutcome *why, CwPassState *state) {
  CwStatus status = CW_OK;
  char text[CW_OUTCOME_TEXT_SIZE];
  const CwDomain *domain = &run->domain[why->domain];
  cw_outcome_text(why, cw_mm(1), text);
  CW_REQUIRE(state->finer_rounds < FINER_MOST, CW_ERR_MESH, "%s: %s; also with edges %d times shorter there",
             domain->name, text, 1 << FINER_MOST);
  cw_log_warn(run->context.log, "%s: %s; made again with shorter edges there", domain->name, text);
  CW_TRY(cw_finer_places_add(domain, why->domain, why->place, &run->finer));
  state->finer_rounds++;
  run->retries++;
done:
  return status;
}

// Asks for shorter edges about flat tetrahedra, some times as long as there are any: cells as large as passages are
// wide leave no room for better ones. Where the last round was not the best, that one is made again. *again: 1 where
// there is anything to make.
static CwStatus shorten_for_flat(CwMeshRun *run, CwPassState *state, int *again) {
  CwStatus status = CW_OK;
  int32_t flat;
  double deficit = cw_flat_deficit(run, &flat);
  int best = state->flat_rounds == 0 || deficit < state->flat_least;
  int more = flat > 0 && (double)run->cells < flat * cw_policy.flat_rare && state->flat_rounds < FLAT_MOST;
  *again = state->flat_rounds <= FLAT_MOST && (more || !best);
  if (best) {
    state->flat_least = deficit;
    state->flat_places = run->finer.count;
  }
  if (!*again) goto done;
  state->flat_rounds = more ? state->flat_rounds + 1 : FLAT_MOST + 1;
  if (more) {
    cw_log(run->context.log, "%d regions have tetrahedra below %.0f degrees; made again with shorter edges there", flat,
           cw_policy.flat_angle);
    CW_TRY(cw_finer_at_flat(run));
    run->retries++;
  } else {
    cw_log(run->context.log, "shorter edges did not help the last tetrahedra below %.0f degrees; taken back",
           cw_policy.flat_angle);
    run->finer.count = state->flat_places;
  }
done:
  return status;
}

// Passes until the asked number of cells is met, and no edges have to be shorter.
static CwStatus run_passes(CwMeshRun *run, const char *fingerprint, CwPassState *state) {
  CwStatus status = CW_OK;
  double asked = (double)run->table->mesh.cells;
  for (;;) {
    CwOutcome outcome;
    int pass = run->passes, again = 0;
    CW_TRY(mesh_pass(run, &outcome));
    if (run->stopped) break;
    if (outcome.kind == CW_OUTCOME_FINER) {
      CW_TRY(shorten_for_layers(run, &outcome, state));
      again = 1;
    } else {
      double off = (double)run->cells / asked - 1;
      cw_log(run->context.log, "pass %d: %lld cells, %.2f %% off the asked %.0f", pass, (long long)run->cells,
             100 * off, asked);
      cw_learn_tets(run);
      if (fabs(off) <= COUNT_TOLERANCE) {
        CW_TRY(shorten_for_flat(run, state, &again));
        if (!again) break;
      } else if (pass == PASSES_MOST) {
        cw_log_warn(run->context.log, "%lld cells made, %.1f %% off the asked %.0f after %d passes",
                    (long long)run->cells, 100 * off, asked, pass);
        break;
      }
    }
    run->passes += !again;
    CW_TRY(keep_state(run, run->passes, fingerprint, state));
    if (again) {
      CW_TRY(begin(run, state, 1));
      if (run->stopped) break;
      continue;
    }
    for (int d = 0; d < run->model.domain_count; d++) run->domain[d].layer_share = CW_LAYER_SHARE;
    cw_mesh_solve_scale(run);
  }
done:
  return status;
}

CwStatus cw_mesh_run(CwMeshRun *run) {
  CwStatus status = CW_OK;
  char path[4096], fingerprint[CW_HASH_TEXT];
  snprintf(path, sizeof path, "%s/mesh", run->run_path);
  CW_TRY(cw_make_directory(path));
  CW_TRY(cw_mesh_open(run));
  CwPassState state = {0};
  CW_TRY(cw_pass_fingerprint(run->table, run->run_path, &run->model, fingerprint));
  CW_TRY(cw_pass_state_read(run->context.log, run->run_path, fingerprint, &state));
  run->finer = state.finer;
  for (int d = 0; d < run->model.domain_count; d++) run->domain[d].more_regions = state.more_regions[d];
  if (state.pass > 0) cw_log(run->context.log, "going on with pass %d of an earlier run", state.pass);
  CW_TRY(begin(run, &state, run->finer.count > 0));
  if (run->stopped) goto done;
  cw_warn_of_few_cells(run);
  run->passes = state.pass > 0 ? state.pass : 1;
  CW_TRY(run_passes(run, fingerprint, &state));
  if (run->stopped) goto done;
  cw_profiler_part(&run->context, "manifest");
  if (run->rank == 0) CW_TRY(cw_mesh_manifest(run));
done:
  return status;
}

void cw_mesh_run_free(CwMeshRun *run) {
  cw_finer_places_free(&run->finer);
  json_decref(run->headlines);
  for (int d = 0; d < run->model.domain_count; d++) {
    cw_domain_close(&run->domain[d]);
    free(run->summary[d]);
    free(run->region_seconds[d]);
  }
}
