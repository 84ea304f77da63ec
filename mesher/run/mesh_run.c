// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/mesh_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/parallel/profiler.h"
#include "mesher/policy.h"
#include "mesher/run/cell_count.h"
#include "mesher/run/manifest.h"
#include "mesher/run/mesh_plan.h"
#include "mesher/run/pass_state.h"
#include "mesher/run/poor_places.h"
#include "mesher/run/run_interfaces.h"
#include "mesher/run/run_layers.h"
#include "mesher/run/run_regions.h"
#include "mesher/run/run_thinning.h"
#include "mesher/run/run_walls.h"
#include "mesher/run/stage_view.h"
#include "pipeline/atomic_file.h"
#include "pipeline/log.h"

// Passes with the same places; rounds of shorter edges for layers, and for quality; after these of other planes, and
// then of fewer layers.
enum { PASSES_MOST = 10, FINER_MOST = 6, POOR_MOST = 4, PLANES_MOST = 3, FEWER_MOST = 3 };
enum { FEWER_PART = 4 };                    // of its layers, that a domain has less in each
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

// Whether the mesh has to be another at the place of an outcome (finer_places).
static int is_of_places(CwOutcomeKind kind) {
  return kind == CW_OUTCOME_FINER || kind == CW_OUTCOME_PINCH;
}

// One pass at the present scale. Where equal passages do not come out equal, the impeller is meshed whole; a domain
// with a plane that grazes a wall, or on which no column leaves one, gets other planes; surfaces and regions that fail
// are tried again with thinner layers, and with other planes where these do not do. Outcome: CW_OUTCOME_FINER where
// edges cross, CW_OUTCOME_PINCH where no layers stand; where `optional`, that of an attempt for which there are no
// other planes.
static CwStatus mesh_pass(CwMeshRun *run, int optional, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  CwThinPlaces places = {0};
  for (int attempt = 0;;) {
    *outcome = (CwOutcome){0};
    places.count = 0;
    CW_TRY(mesh_attempt(run, &places, outcome));
    if (outcome->kind == CW_OUTCOME_DONE || is_of_places(outcome->kind)) break;
    if (outcome->kind == CW_OUTCOME_THIN) {
      *outcome = (CwOutcome){0};
      CW_TRY(cw_thin(run, &places, attempt++, outcome));
      if (outcome->kind == CW_OUTCOME_DONE) continue;
    }
    if (optional && !(outcome->kind == CW_OUTCOME_REPLAN && cw_mesh_has_other_plan(run, outcome->domain))) break;
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
  return (CwCellLaw){rounded(law->factor), rounded(law->scale), rounded(law->exponent), law->layers};
}

// What a run that goes on from here has to know.
static CwStatus keep_state(CwMeshRun *run, const char *fingerprint, CwPassState *state) {
  CwStatus status = CW_OK;
  state->pass = run->passes;
  state->finer = run->finer;
  if (run->rank == 0) CW_TRY(cw_pass_state_write(run->run_path, fingerprint, state));
done:
  return status;
}

// What the next mesh follows from, with as many digits as the file keeps.
static CwPassStart start_of(const CwMeshRun *run) {
  CwPassStart start = {
      .prisms = rounded_law(&run->prisms), .tets = rounded_law(&run->tets), .places = run->finer.count};
  for (int d = 0; d < run->model.domain_count; d++) {
    start.whole[d] = run->domain[d].whole;
    start.more_regions[d] = run->domain[d].more_regions;
    start.layers[d] = run->domain[d].layer_count;
  }
  return start;
}

// From the size fields to the plan, then the factors and the scale of the state. `again`: the fields are not those that
// the run has opened with.
static CwStatus begin(CwMeshRun *run, const CwPassState *state, int again) {
  CwStatus status = CW_OK;
  for (int d = 0; d < run->model.domain_count; d++) run->domain[d].more_regions = state->start.more_regions[d];
  if (again) CW_TRY(cw_mesh_resize(run));
  CW_TRY(cw_stage_view(run, CW_STAGE_SIZE));
  if (run->stopped) goto done;
  cw_start_factors(run);
  CW_TRY(cw_mesh_plan(run));
  CW_TRY(cw_stage_view(run, CW_STAGE_DECOMPOSITION));
  if (run->stopped) goto done;
  cw_mesh_take_start(run, &state->start);
  CW_TRY(cw_mesh_plan_whole(run, state->start.whole, state->plane_rounds > 0 ? "they fall short" : "as before"));
done:
  return status;
}

// Asks for shorter edges where edges cross or layers do not stand; for no layers where short edges do not do.
static CwStatus change_places(CwMeshRun *run, const CwOutcome *why, CwPassState *state) {
  CwStatus status = CW_OK;
  char text[CW_OUTCOME_TEXT_SIZE];
  const CwDomain *domain = &run->domain[why->domain];
  const int32_t before = run->finer.count;
  int shorter = state->finer_rounds < FINER_MOST;
  cw_outcome_text(why, cw_mm(1), text);
  for (int32_t i = 0; i < why->places; i++) {
    if (shorter)
      CW_TRY(cw_finer_places_add(domain, why->domain, why->place[i], &run->finer));
    else if (why->kind == CW_OUTCOME_PINCH)
      CW_TRY(cw_finer_places_add_pinched(domain, why->domain, why->place[i], before, &run->finer));
  }
  CW_REQUIRE(run->finer.count > before, CW_ERR_MESH,
             "%s: %s; also with edges %d times shorter there; allowed: a wall that neither folds nor touches itself "
             "there, or more mesh.cells than %lld",
             domain->name, text, 1 << FINER_MOST, (long long)run->table->mesh.cells);
  cw_log_warn(run->context.log, "%s: %s; made again with %s there", domain->name, text,
              shorter ? "shorter edges" : "no layers");
  CW_TRY(cw_mesh_pinch(run, before));
  state->finer_rounds += shorter;
  run->retries++;
done:
  return status;
}

// Of a domain in a round of fewer layers; in round 0 as many as the best mesh has.
static int layers_left(const CwPassState *state, int d, int round) {
  int made = state->best_layers[d], left = made - round * (made / FEWER_PART);
  return made <= CW_LAYERS_LEAST ? made : left > CW_LAYERS_LEAST ? left : CW_LAYERS_LEAST;
}

// Of fewer layers in the domains that fall short, where edges are longer than so many leave room for. 0 where they
// would be no fewer than before.
static int take_fewer_layers(CwPassState *state) {
  int fewer = 0, round = state->plane_rounds - PLANES_MOST;
  for (int d = 0; d < CW_DOMAINS_MOST && round <= FEWER_MOST; d++)
    fewer |= state->best_lacks[d] && layers_left(state, d, round) < layers_left(state, d, round - 1);
  for (int d = 0; d < CW_DOMAINS_MOST && fewer; d++) {
    int left = layers_left(state, d, round);
    if (state->best_lacks[d] && left < state->best_layers[d]) state->start.layers[d] = left;
  }
  return fewer;
}

// What the next round begins with where shorter edges do not help: the best mesh, in which the domains that fall short
// get other planes, of more regions each time, and the last time of no symmetry, since fewer planes leave layers more
// room; then fewer layers. NULL where there are no such rounds left: then the best mesh as it was; else what it has.
static const char *take_other(CwMeshRun *run, CwPassState *state) {
  int other = 0;
  state->start = state->best;
  run->finer.count = state->best.places;
  state->plane_rounds++;
  for (int d = 0; d < CW_DOMAINS_MOST && state->plane_rounds <= PLANES_MOST; d++) {
    if (!state->best_lacks[d] || state->best.more_regions[d] == CW_UNDIVIDED) continue;
    state->start.more_regions[d] += state->plane_rounds;
    state->start.whole[d] |= state->plane_rounds == PLANES_MOST;
    other = 1;
  }
  if (other) return "other planes";
  if (state->plane_rounds <= PLANES_MOST) state->plane_rounds = PLANES_MOST + 1;
  return take_fewer_layers(state) ? "fewer layers" : NULL;
}

// Asks for shorter edges about flat tetrahedra and missed first heights, as long as these become fewer: where edges are
// as long as a passage is wide no filling is better. After a second round that did not help the domains that fall short
// get other planes, and fewer layers. Then the best mesh is made again. made: whether there is a mesh that may stand,
// of as many cells as asked or what the first passes came to; *again: 1 where there is anything to make.
static CwStatus improve(CwMeshRun *run, CwPassState *state, int made, int *again) {
  CwStatus status = CW_OK;
  int32_t poor = 0;
  double deficit = made ? cw_poor_deficit(run, &poor) : INFINITY;
  int many = made && poor > 0 && (double)run->cells < poor * cw_policy.poor_rare;
  int best = made && (state->poor_rounds == 0 || deficit < state->least_deficit);
  const char *other;
  if (best) {
    state->best = state->start;
    state->best_round = state->poor_rounds;
    state->least_deficit = deficit;
    memset(state->best_lacks, 0, sizeof state->best_lacks);
    if (many) cw_poor_domains(run, state->best_lacks);
    for (int d = 0; d < run->model.domain_count; d++)
      state->best_layers[d] = run->scale > cw_size_scale_fine() ? run->domain[d].layer_count : 0;
  }
  if (state->poor_rounds > POOR_MOST) {
    CW_AUDIT(deficit == state->least_deficit ? CW_OK : CW_FAIL(CW_ERR_MESH, "the best mesh, made again, is another"));
    goto done;
  }
  if (many && state->poor_rounds < POOR_MOST && (best || state->poor_rounds == state->best_round + 1)) {
    cw_log(run->context.log,
           "regions with flat tetrahedra, or domains that miss first heights: %d; made again with shorter edges there",
           poor);
    CW_TRY(cw_finer_at_poor(run));
    state->start = start_of(run);
    state->poor_rounds++;
  } else if ((other = take_other(run, state))) {
    cw_log(run->context.log, "domains fall short; they are made again with %s", other);
    state->poor_rounds = POOR_MOST;
  } else if (!best) {
    cw_log(run->context.log, "that did not help; the best mesh is made again");
    state->poor_rounds = POOR_MOST + 1;
  } else {
    goto done;
  }
  *again = 1;
  run->retries++;
done:
  return status;
}

// After a pass that has ended with layers: whether it was the last, or one *again with other places.
static CwStatus judge_pass(CwMeshRun *run, CwPassState *state, int *last, int *again) {
  CwStatus status = CW_OK;
  double asked = (double)run->table->mesh.cells, off = (double)run->cells / asked - 1;
  int met = fabs(off) <= COUNT_TOLERANCE;
  cw_log(run->context.log, "pass %d: %lld cells, %.2f %% off the asked %.0f", run->passes, (long long)run->cells,
         100 * off, asked);
  cw_learn_tets(run);
  *last = met || run->passes - state->first_pass + 1 >= PASSES_MOST;
  if (*last) CW_TRY(improve(run, state, met || state->poor_rounds == 0, again));
  if (*last && !*again && !met)
    cw_log_warn(run->context.log,
                "mesh.cells: %lld cells made, %.1f %% off the asked %.0f after %d passes; wanted: within %.0f %%",
                (long long)run->cells, 100 * off, asked, PASSES_MOST, 100 * COUNT_TOLERANCE);
done:
  return status;
}

// Passes until the asked number of cells is met, and no edges have to be shorter.
static CwStatus run_passes(CwMeshRun *run, const char *fingerprint, CwPassState *state) {
  CwStatus status = CW_OK;
  for (;;) {
    CwOutcome outcome;
    int last = 0, again = 0, optional = state->poor_rounds > 0 && state->poor_rounds <= POOR_MOST;
    CW_TRY(mesh_pass(run, optional, &outcome));
    if (run->stopped) break;
    if (optional && outcome.kind != CW_OUTCOME_DONE) {
      cw_log(run->context.log, "no mesh with these: %s", outcome.reason);
      CW_TRY(improve(run, state, 0, &again));
    } else if (is_of_places(outcome.kind)) {
      CW_TRY(change_places(run, &outcome, state));
      state->start = start_of(run);
      again = 1;
    } else {
      CW_TRY(judge_pass(run, state, &last, &again));
    }
    if (last && !again) break;
    if (again) {
      state->first_pass = run->passes;
      CW_TRY(keep_state(run, fingerprint, state));
      CW_TRY(begin(run, state, 1));
      if (run->stopped) break;
      continue;
    }
    run->passes++;
    state->start = start_of(run);
    CW_TRY(keep_state(run, fingerprint, state));
    for (int d = 0; d < run->model.domain_count; d++) run->domain[d].layer_share = CW_LAYER_SHARE;
    cw_mesh_take_start(run, &state->start);
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
  if (run->rank == 0) CW_TRY(cw_pass_state_read(run->context.log, run->run_path, fingerprint, &state));
  CW_TRY(cw_pass_state_share(run->context.team, &state));
  run->finer = state.finer;
  CW_TRY(cw_mesh_pinch(run, 0));
  if (state.pass > 0) cw_log(run->context.log, "going on with pass %d of an earlier run", state.pass);
  CW_TRY(begin(run, &state, run->finer.count > 0));
  if (run->stopped) goto done;
  cw_warn_of_few_cells(run);
  run->passes = state.pass > 0 ? state.pass : 1;
  if (state.pass == 0) state.first_pass = 1;
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
  for (int again = 0; again < 2; again++) cw_host_memory_free(&run->sizes[again]);
}
