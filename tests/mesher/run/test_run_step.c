// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "launch.h"
#include "mesher/run/run_step.h"
#include "tests/unit_test.h"

// A run with one wall, one plane and one vertex of a curve. Of the second rank one of its numbers is another in the
// last bit.
static int be_a_rank(int argc, char **argv) {
  static CwMeshRun run;
  double x[1][3] = {{1, 2, 3}}, cost = 5;
  CwModelPatch patch = {.kind = CW_PATCH_WALL};
  CwLayerTarget layers = {.first_height = 1e-5, .growth = 1.2};
  CwPlanNode node = {.plane = {{0, 0, 1}, 0.5}};
  CwTeam *all;
  CwLog *log = NULL;
  begin_as_rank(&argc, &argv, &all);
  cw_log_open("test", NULL, cw_team_rank(all) == 0, 0, &log);
  run.context.team = all;
  run.model = (CwModel){.domain_count = 1, .patch_count = 1, .patch = &patch};
  run.scale = 0.7;
  run.tets.factor = 9;
  CwDomain *domain = &run.domain[0];
  domain->patch = &patch;
  domain->patch_layers = &layers;
  domain->plan = (CwPlan){.node_count = 1, .node = &node};
  domain->wall_curves = (CwWallCurves){.vertex_count = 1, .x = x};
  const struct {
    const char *mode;
    double *number;
  } other[] = {{"scale", &run.scale},         {"cells", &run.tets.factor}, {"layers", &layers.growth},
               {"plane", &node.plane.offset}, {"curve", &x[0][2]},         {"cost", &cost}};
  for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
    if (!strcmp(argv[1], other[i].mode) && cw_team_rank(all) == 1)
      *other[i].number = nextafter(*other[i].number, INFINITY);
  }
  CwStatus status = cw_run_alike(&run, &cost, sizeof cost);
  if (status != CW_OK) return cw_mpi_fail(log, status);
  printf("RANK %d WRONG 0\n", cw_team_rank(all));
  cw_log_close(&log);
  return end_as_rank(all, 0);
}

enum { ITEMS = 2, WORDS = 1 << 18 }; // of a result: so large that ranks share it

static CwStatus fill(CwMeshRun *run, CwMeshTask task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  int32_t *word = NULL;
  (void)run;
  CW_NEW(word, WORDS);
  for (int32_t i = 0; i < WORDS; i++) word[i] = WORDS * task.index + i;
  *bytes = word;
  *size = (int64_t)WORDS * (int64_t)sizeof *word;
done:
  return status;
}

// Results are kept: where the ranks share them, the lists go and the words stay; else all goes but what was taken.
static int keep_as_rank(int argc, char **argv) {
  static CwMeshRun run;
  CwTeam *all;
  CwResults results = {.shared = 1};
  const int32_t *word[ITEMS], count[1] = {ITEMS};
  CwMeshTask task[ITEMS] = {{0, 0, 1}, {0, 1, 1}};
  int wrong = 0;
  begin_as_rank(&argc, &argv, &all);
  run.context.team = all;
  run.rank = cw_team_rank(all);
  CwStatus status = cw_record_start("mesh", NULL, &run.record);
  if (status == CW_OK) status = cw_results_make(&results, 1, count);
  if (status == CW_OK) status = cw_run_step(&run, "words", "words", fill, ITEMS, task, NULL, &results, NULL);
  if (status != CW_OK) return cw_mpi_fail(NULL, status);
  int shared = results.memory != NULL;
  void *taken = results.bytes[0][0];
  for (int i = 0; i < ITEMS; i++) word[i] = results.bytes[0][i];
  if (!shared) results.bytes[0][0] = NULL;
  CwHostMemory *memory = cw_results_keep(&results);
  wrong += shared != (cw_team_ranks(all) > 1) || (memory != NULL) != shared || results.bytes[0] || results.memory;
  for (int i = 0; i < (shared ? ITEMS : 1); i++) {
    for (int32_t k = 0; k < WORDS; k++) wrong += word[i][k] != WORDS * i + k;
  }
  printf("RANK %d WRONG %d\n", run.rank, wrong);
  if (!shared) free(taken);
  cw_host_memory_free(&memory);
  cw_record_free(run.record);
  return end_as_rank(all, 0);
}

static void kept_results_stay_where_they_are_shared(void **state) {
  for (int ranks = 1; ranks <= 3; ranks++) launch_and_find_right(ranks, "keep", 1);
}

static void ranks_that_are_alike_go_on(void **state) {
  for (int ranks = 1; ranks <= 3; ranks++) launch_and_find_right(ranks, "alike", 1);
}

static void a_bit_that_differs_ends_the_run(void **state) {
  static const char *const MODES[] = {"scale", "cells", "layers", "plane", "curve", "cost"};
  for (size_t i = 0; i < sizeof MODES / sizeof *MODES; i++) {
    assert_int_equal(launch(3, MODES[i]), CW_ERR_LIBRARY);
    assert_int_equal(count_lines_with("error:"), 1);
    assert_non_null(strstr(output, "error: sizes, planes or curves of rank 1 on "));
  }
}

int main(int argc, char **argv) {
  if (launched(argc)) return strcmp(argv[1], "keep") ? be_a_rank(argc, argv) : keep_as_rank(argc, argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ranks_that_are_alike_go_on),
      cmocka_unit_test(a_bit_that_differs_ends_the_run),
      cmocka_unit_test(kept_results_stay_where_they_are_shared),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
