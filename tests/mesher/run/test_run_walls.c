// SPDX-License-Identifier: AGPL-3.0-or-later
// How often walls are made, and at which scale. What makes them is set by hand here, in place of that of the library,
// with as many cells too many as a test says; each call leaves letters in a trace,
//
//   D start (of domain)   C edges coupled   E wall curves (of domain)   = alike on all ranks   v view   S faces meshed
//   M merged   P prisms learnt   R scale solved   K scale set   V scale fitted to the volume
#include <stdlib.h>
#include <string.h>

#include "mesher/run/cell_count.h"
#include "mesher/run/run_layers.h"
#include "mesher/run/run_walls.h"
#include "mesher/run/stage_view.h"
#include "mesher/thickness/coupled_edges.h"
#include "tests/unit_test.h"

enum { FACES = 3 };

static CwMeshRun run;
static const double *off; // of each pass, over the asked number
static int pass, held;    // results that were made and not freed
static char trace[500];
static CwOutcomeKind of_start, of_merge; // of the second domain
static CwStatus of_step;

static void add(const char *text) {
  assert_true(strlen(trace) + strlen(text) < sizeof trace);
  strcat(trace, text);
}

static const char *number_of(const CwDomain *domain) {
  return domain == &run.domain[0] ? "0" : "1";
}

CwStatus cw_domain_start(const CwContext *context, CwDomain *domain, CwOutcome *outcome) {
  add("D");
  add(number_of(domain));
  if (domain == &run.domain[1]) outcome->kind = of_start;
  return CW_OK;
}

// The outlet of the first domain and the inlet of the second.
CwStatus cw_couple_open_edges(const CwBoundaryInput *in_a, const char *patch_a, CwOpenEdges *edges_a,
                              const CwBoundaryInput *in_b, const char *patch_b, CwOpenEdges *edges_b) {
  add("C");
  assert_string_equal(patch_a, "rotor_out");
  assert_string_equal(patch_b, "stator_in");
  assert_ptr_equal(in_a, &run.domain[0].input);
  assert_ptr_equal(in_b, &run.domain[1].input);
  assert_ptr_equal(edges_a, &run.domain[0].open_edges);
  assert_ptr_equal(edges_b, &run.domain[1].open_edges);
  return CW_OK;
}

CwStatus cw_wall_curves_make(const CwContext *context, const CwBoundaryInput *in, const CwOpenEdges *edges,
                             CwWallCurves *curves) {
  const CwDomain *domain = &run.domain[in == &run.domain[1].input];
  add("E");
  add(number_of(domain));
  assert_ptr_equal(edges, &domain->open_edges);
  assert_ptr_equal(curves, &domain->wall_curves);
  return CW_OK;
}

CwStatus cw_run_alike(const CwMeshRun *of, const void *also, size_t size) {
  add("=");
  assert_int_equal(size, sizeof(CwOutcomeKind));
  assert_int_equal(*(const CwOutcomeKind *)also, of_start);
  return CW_OK;
}

CwStatus cw_stage_view(CwMeshRun *of, CwStage stage) {
  add("v");
  assert_int_equal(stage, CW_STAGE_CURVES);
  of->stopped = of->stop_after == stage;
  return CW_OK;
}

void cw_face_counts(const CwMeshRun *of, int32_t count[CW_DOMAINS_MOST]) {
  count[0] = FACES;
  count[1] = 1;
}

CwStatus cw_face_tasks(const CwMeshRun *of, int walls, int32_t *count, CwMeshTask **tasks) {
  CwStatus status = CW_OK;
  assert_int_equal(walls, 1);
  *count = 2;
  CW_NEW(*tasks, 2);
done:
  return status;
}

CwStatus cw_results_make(CwResults *results, int domains, const int32_t *count) {
  CwStatus status = CW_OK;
  assert_int_equal(domains, 2);
  assert_int_equal(count[0], FACES);
  assert_int_equal(count[1], 1);
  assert_int_equal(results->shared, 1);
  assert_null(results->bytes[0]);
  CW_NEW(results->bytes[0], 1);
  held++;
done:
  return status;
}

void cw_results_free(CwResults *results) {
  held -= results->bytes[0] != NULL;
  free(results->bytes[0]);
  results->bytes[0] = NULL;
}

CwStatus cw_step_wall(CwMeshRun *of, CwMeshTask task, void **bytes, int64_t *size) {
  return CW_OK;
}

CwStatus cw_run_step(CwMeshRun *of, const char *name, const char *unit, CwMeshStep body, int32_t count,
                     const CwMeshTask *task, const int32_t *after, CwResults *results, double **seconds) {
  add("S");
  assert_ptr_equal(body, cw_step_wall);
  assert_int_equal(count, 2);
  assert_null(after);
  assert_non_null(results->bytes[0]);
  return of_step;
}

CwStatus cw_run_merge_walls(CwMeshRun *of, const CwResults *results, CwOutcome *outcome) {
  add("M");
  assert_non_null(results->bytes[0]);
  outcome->kind = of_merge;
  return CW_OK;
}

void cw_learn_prisms(CwMeshRun *of) {
  add("P");
  pass++;
}

double cw_predicted_off(const CwMeshRun *of) {
  return off[pass - 1];
}

void cw_mesh_set_scale(CwMeshRun *of, double scale) {
  add("K");
  of->scale = scale;
}

void cw_mesh_solve_scale(CwMeshRun *of) {
  add("R");
  of->scale *= 1.25;
}

void cw_mesh_fit_volume(CwMeshRun *of) {
  add("V");
  of->scale = 77;
}

static int start_anew(void **state) {
  static CwModelPatch patch[] = {{.name = "rotor_in"}, {.name = "rotor_out"}, {.name = "stator_in", .domain = 1}};
  static CwModelInterface interface = {.patch = {1, 2}};
  memset(&run, 0, sizeof run);
  run.model =
      (CwModel){.domain_count = 2, .patch_count = 3, .interface_count = 1, .patch = patch, .interface = &interface};
  run.surface_scale = 0.5;
  of_start = of_merge = CW_OUTCOME_DONE;
  of_step = CW_OK;
  return 0;
}

// Makes walls from a scale on; gives the outcome.
static CwOutcome make(double scale, const double *cells_off, const char *wanted) {
  CwOutcome outcome = {0};
  run.scale = scale;
  off = cells_off;
  pass = 0;
  trace[0] = '\0';
  if (cw_run_walls(&run, &outcome) != CW_OK) fail_msg("%s", cw_fail_message());
  assert_string_equal(trace, wanted);
  assert_int_equal(held, 0);
  return outcome;
}

#define PASS "D0D1CE0E1=vSMP"

// At scales above 1 within 1 %, else within 3 %; three times at the most. The scale of the walls is that of the last.
static void walls_are_made_until_their_cells_fit(void **state) {
  static const struct {
    double scale, off[3], left;
    const char *trace;
  } runs[] = {{1.5, {0.0099}, 1.5, PASS},
              {1.5, {-0.0099}, 1.5, PASS},
              {1.5, {0.0101, -0.0099}, 1.875, PASS "R" PASS},
              {1.5, {-0.0101, 0.02, 0.5}, 1.5 * 1.5625, PASS "R" PASS "R" PASS},
              {1, {0.0299}, 1, PASS "V"},
              {0.4, {-0.0299}, 0.4, PASS "V"},
              {0.4, {-0.0301, 0.01}, 0.5, PASS "R" PASS "V"},
              {0.4, {0.2, 0.1, 0.0301}, 0.625, PASS "R" PASS "R" PASS},
              {0.9, {0.04, 0.02, 0.001}, 1.125 * 1.25, PASS "R" PASS "R" PASS}}; // above 1 since the second
  for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
    assert_int_equal(make(runs[i].scale, runs[i].off, runs[i].trace).kind, CW_OUTCOME_DONE);
    assert_near(run.surface_scale, runs[i].left, 0);
    assert_near(run.scale, strchr(runs[i].trace, 'V') ? 77 : runs[i].left, 0);
  }
}

// For thinner layers the same walls once, at the scale that they had, in whichever domain layers are thinned.
static void thinner_layers_have_the_same_walls(void **state) {
  double most = 1;
  for (int d = 0; d < 2; d++) {
    run.most_thickness[d] = &most;
    make(3, (const double[]){0.5}, "K" PASS);
    assert_near(run.scale, 0.5, 0);
    assert_near(run.surface_scale, 0.5, 0);
    make(3, (const double[]){0.02}, "K" PASS "V"); // at 0.5
    assert_near(run.surface_scale, 0.5, 0);
    run.most_thickness[d] = NULL;
  }
}

// All ranks agree on what the start came to.
static void an_outcome_ends_the_stage(void **state) {
  of_start = CW_OUTCOME_REPLAN;
  CwOutcome outcome = make(1.5, (const double[]){0}, "D0D1=");
  assert_int_equal(outcome.kind, CW_OUTCOME_REPLAN);
  assert_int_equal(outcome.domain, 1);
  of_start = CW_OUTCOME_DONE;
  of_merge = CW_OUTCOME_FINER;
  outcome = make(1.5, (const double[]){0}, "D0D1CE0E1=vSM");
  assert_int_equal(outcome.kind, CW_OUTCOME_FINER);
  assert_near(run.surface_scale, 0.5, 0);
}

static void a_run_may_end_with_the_curves(void **state) {
  run.stop_after = CW_STAGE_CURVES;
  make(0.8, (const double[]){0}, "D0D1CE0E1=v");
  assert_int_equal(run.stopped, 1);
  assert_near(run.surface_scale, 0.5, 0);
}

static void an_error_ends_the_run(void **state) {
  CwOutcome outcome = {0};
  of_step = CW_ERR_GEOMETRY;
  trace[0] = '\0';
  assert_int_equal(cw_run_walls(&run, &outcome), CW_ERR_GEOMETRY);
  assert_string_equal(trace, "D0D1CE0E1=vS");
  assert_int_equal(held, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup(walls_are_made_until_their_cells_fit, start_anew),
      cmocka_unit_test_setup(thinner_layers_have_the_same_walls, start_anew),
      cmocka_unit_test_setup(an_outcome_ends_the_stage, start_anew),
      cmocka_unit_test_setup(a_run_may_end_with_the_curves, start_anew),
      cmocka_unit_test_setup(an_error_ends_the_run, start_anew),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
