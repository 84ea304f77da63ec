// SPDX-License-Identifier: AGPL-3.0-or-later
// The order in which a run makes its stages, and when it makes them again. The stages are set by hand here, in place of
// those of the library: each attempt ends as a test says, and each call leaves letters in a trace,
//
//   o open   z sizes anew   f first factors   p plan (more regions of either domain)   h whole (1: of which domain)
//   w warning of few cells   W walls   L layers   I interfaces   U rule of region numbers   G regions
//   T thinner layers (attempt)   e end of thinning   A another plan (of domain)   N tetrahedra learnt   S scale solved
//   F finer place (of domain)   Q finer at poor places   m manifest
#pragma once

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include "mesher/parallel/team.h"
#include "mesher/policy.h"
#include "mesher/run/cell_count.h"
#include "mesher/run/manifest.h"
#include "mesher/run/mesh_plan.h"
#include "mesher/run/mesh_run.h"
#include "mesher/run/poor_places.h"
#include "mesher/run/run_interfaces.h"
#include "mesher/run/run_layers.h"
#include "mesher/run/run_regions.h"
#include "mesher/run/run_walls.h"
#include "mesher/run/stage_view.h"
#include "pipeline/case_schema.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// How an attempt ends: at a stage (its letter) with an outcome of a domain, or with an error; else with so many cells
// over the asked number, and poor regions with their deficit.
typedef struct {
  char stage;
  CwOutcomeKind kind;
  int domain;
  CwStatus error;
  double cells, deficit;
  int32_t poor;
} Attempt;

static CwMeshRun run;
static CwCase table;
static const Attempt *script; // the last attempt goes on for ever
static int script_count, at;
static char trace[1000];
static int other_plans;    // that each domain still has
static int crowded_layers; // of the stator, where edges are too long for them
static int64_t asked = 100000;
static double factor_at_scale;

static void add(const char *format, ...) {
  va_list arguments;
  const size_t used = strlen(trace);
  va_start(arguments, format);
  vsnprintf(trace + used, sizeof trace - used, format, arguments);
  va_end(arguments);
  assert_true(strlen(trace) < sizeof trace - 1); // else the run has no end
}

static const Attempt *now(void) {
  return &script[at < script_count ? at : script_count - 1];
}

static CwStatus stage(char letter, CwThinPlaces *places, CwOutcome *outcome) {
  add("%c", letter);
  if (now()->stage != letter) return CW_OK;
  if (now()->error != CW_OK) return CW_FAIL(now()->error, "stage %c", letter);
  const double place[3] = {1, 2, 3};
  cw_outcome_set(outcome, now()->kind, place, "as the script says");
  outcome->domain = now()->domain;
  if (places) places->count++;
  return CW_OK;
}

CwStatus cw_mesh_open(CwMeshRun *of) {
  add("o");
  of->model.domain_count = 2;
  strcpy(of->model.domain[0].name, "rotor");
  strcpy(of->model.domain[1].name, "stator");
  of->domain[0].name = "rotor";
  of->domain[1].name = "stator";
  of->domain[1].layer_count = crowded_layers;
  of->scale = crowded_layers > 0 ? 1.01 * cw_size_scale_fine() : 0.99 * cw_size_scale_fine();
  return CW_OK;
}

CwStatus cw_mesh_resize(CwMeshRun *of) {
  add("z");
  for (int d = 0; d < 2; d++) of->domain[d].whole = 0;
  return CW_OK;
}

void cw_start_factors(CwMeshRun *of) {
  add("f");
  of->prisms = (CwCellLaw){.factor = 2};
  of->tets = (CwCellLaw){.factor = 9};
}

CwStatus cw_mesh_plan(CwMeshRun *of) {
  add("p%d%d", of->domain[0].more_regions, of->domain[1].more_regions);
  return CW_OK;
}

CwStatus cw_mesh_plan_whole(CwMeshRun *of, const int32_t *whole, const char *reason) {
  add("h%d%d", whole[0], whole[1]);
  for (int d = 0; d < 2; d++) of->domain[d].whole |= whole[d];
  return CW_OK;
}

CwStatus cw_mesh_plan_again(CwMeshRun *of, const CwOutcome *why) {
  add("A%d", why->domain);
  if (other_plans-- == 0) return CW_FAIL(CW_ERR_MESH, "no plan fits");
  if (why->kind == CW_OUTCOME_ASYMMETRIC)
    of->domain[why->domain].whole = 1;
  else
    of->domain[why->domain].more_regions++;
  return CW_OK;
}

int cw_mesh_has_other_plan(const CwMeshRun *of, int d) {
  return other_plans > 0;
}

void cw_warn_of_few_cells(const CwMeshRun *of) {
  add("w");
}

CwStatus cw_run_walls(CwMeshRun *of, CwOutcome *outcome) {
  at++;
  of->prisms.factor = 2. / 3;
  of->stopped = of->stop_after == CW_STAGE_CURVES;
  return stage('W', NULL, outcome);
}

CwStatus cw_run_layers(CwMeshRun *of, CwOutcome *outcome) {
  return stage('L', NULL, outcome);
}

CwStatus cw_run_interfaces(CwMeshRun *of, CwThinPlaces *places, CwOutcome *outcome) {
  return stage('I', places, outcome);
}

CwStatus cw_run_region_rule(CwMeshRun *of) {
  return stage('U', NULL, &(CwOutcome){0});
}

CwStatus cw_run_regions(CwMeshRun *of, CwThinPlaces *places, CwOutcome *outcome) {
  of->cells = llround(now()->cells * (double)asked);
  return stage('G', places, outcome);
}

CwStatus cw_thin(CwMeshRun *of, const CwThinPlaces *places, int attempt, CwOutcome *outcome) {
  add("T%d", attempt);
  assert_int_equal(places->count, 1); // of this attempt alone
  assert_int_equal(outcome->kind, CW_OUTCOME_DONE);
  if (attempt == 3) cw_outcome_set(outcome, CW_OUTCOME_REPLAN, NULL, "thin enough");
  outcome->domain = 1;
  return CW_OK;
}

void cw_thin_places_free(CwThinPlaces *places) {}

void cw_end_thinning(CwMeshRun *of) {
  add("e");
}

void cw_learn_tets(CwMeshRun *of) {
  add("N");
  of->tets = (CwCellLaw){.factor = 1. / 3, .scale = 1};
}

void cw_mesh_take_start(CwMeshRun *of, const CwPassStart *start) {
  if (start->layers[1] > 0) add("k%d", of->domain[1].layer_count = start->layers[1]);
  if (start->prisms.factor == 0) return;
  of->prisms = start->prisms;
  of->tets = start->tets;
  add("S");
  factor_at_scale = of->tets.factor;
}

double cw_poor_deficit(const CwMeshRun *of, int32_t *count) {
  *count = now()->poor;
  return now()->deficit;
}

void cw_poor_domains(const CwMeshRun *of, int32_t lacks[CW_DOMAINS_MOST]) {
  lacks[1] = 1;
}

CwStatus cw_finer_at_poor(CwMeshRun *of) {
  add("Q");
  return cw_finer_places_add(&of->domain[1], -1, (const double[3]){0, 0, 0}, &of->finer);
}

CwStatus cw_finer_places_add(const CwDomain *domain, int32_t number, const double x[3], CwFinerPlaces *places) {
  CwStatus status = CW_OK;
  if (number >= 0) add("F%d", number);
  CW_GROW(places->place, places->capacity, places->count + 1);
  places->place[places->count++] = (CwFinerPlace){number, 0, {{x[0], x[1], x[2]}, 1}};
done:
  return status;
}

CwStatus cw_finer_places_add_pinched(const CwDomain *domain, int32_t number, const double x[3], int32_t before,
                                     CwFinerPlaces *places) {
  CwStatus status = CW_OK;
  assert_int_equal(before, places->count);
  CW_GROW(places->place, places->capacity, places->count + 1);
  places->place[places->count++] = (CwFinerPlace){number, 1, {{x[0], x[1], x[2]}, 1}};
done:
  return status;
}

CwStatus cw_mesh_pinch(CwMeshRun *of, int32_t first) {
  for (int32_t i = first; i < of->finer.count; i++)
    if (of->finer.place[i].pinched) add("P%d", i);
  return CW_OK;
}

void cw_finer_places_free(CwFinerPlaces *places) {
  free(places->place);
  memset(places, 0, sizeof *places);
}

CwStatus cw_mesh_manifest(CwMeshRun *of) {
  add("m");
  return CW_OK;
}

CwStatus cw_stage_view(CwMeshRun *of, CwStage seen) {
  if (of->stop_after == seen) of->stopped = 1;
  return CW_OK;
}

void cw_domain_close(CwDomain *domain) {}
