// SPDX-License-Identifier: AGPL-3.0-or-later
// What the stage of the regions asks for, and what it makes of the answers. The steps that it runs are set by hand
// here, in place of those of the library: each region has its summary.
#include <stdlib.h>
#include <string.h>

#include "mesher/run/run_regions.h"
#include "mesher/run/run_step.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

// A rotor with a region before three equal passages of two regions each, and a stator of two regions.
enum { PASSAGES = 3, ROTOR = 1 + 2 * PASSAGES, STATOR = 2, TASKS = ROTOR + STATOR };

static CwMeshRun run;
static CwSymmetry symmetry = {.count = PASSAGES};
static double cells[2][ROTOR] = {{100, 200, 300, 200, 300, 200, 300}, {40, 50}};

// What the step was handed, and what it gives back: nothing for the images of a region that has failed.
static CwMeshTask task[TASKS];
static int32_t after[TASKS], task_count, shared, thinned;
static int32_t failed_region; // of the rotor; -1: none
static uint64_t open_faces[2][ROTOR];
static const char *damage;
static int (*in_vain)(const void *bytes);
static double **seconds_of;

CwStatus cw_domain_share(CwLog *log, CwDomain *domain, const CwCase *table) {
  shared++;
  return CW_OK;
}

CwStatus cw_step_region(CwMeshRun *of, CwMeshTask one, void **bytes, int64_t *size) {
  return CW_OK;
}

int32_t cw_region_copies(const CwDomain *domain, int32_t region) {
  return domain->images.symmetry && region > 0 ? PASSAGES : 1;
}

CwStatus cw_thin_places_in_regions(const CwMeshRun *of, CwThinPlaces *places) {
  thinned++;
  places->count = 1;
  return CW_OK;
}

CwStatus cw_results_make(CwResults *results, int domains, const int32_t *count) {
  CwStatus status = CW_OK;
  assert_int_equal(domains, 2);
  for (int d = 0; d < 2; d++) {
    results->count[d] = count[d];
    CW_NEW(results->bytes[d], count[d]);
  }
done:
  return status;
}

void cw_results_free(CwResults *results) {
  for (int d = 0; d < 2; d++) {
    for (int32_t i = 0; results->bytes[d] && i < results->count[d]; i++) free(results->bytes[d][i]);
    free(results->bytes[d]);
    results->bytes[d] = NULL;
  }
}

static int32_t first_of(const CwMeshTask *one) {
  return one->domain == 0 && one->index > 2 ? 1 + (one->index - 1) % 2 : one->index;
}

// A region has tetrahedra, pyramids and prisms by its number; its images tell their digest and open faces alone.
CwStatus cw_run_step(CwMeshRun *of, const char *name, const char *unit, CwMeshStep body, int32_t count,
                     const CwMeshTask *tasks, const int32_t *follows, CwResults *results, double **seconds) {
  CwStatus status = CW_OK;
  assert_string_equal(name, "regions");
  assert_ptr_equal(body, cw_step_region);
  assert_in_range(count, 1, TASKS);
  task_count = count;
  memcpy(task, tasks, (size_t)count * sizeof *task);
  memcpy(after, follows, (size_t)count * sizeof *after);
  in_vain = results->in_vain;
  seconds_of = seconds;
  for (int32_t i = 0; i < count; i++) {
    const int32_t d = task[i].domain, r = task[i].index, first = first_of(&task[i]);
    CwRegionSummary *made = NULL;
    if (d == 0 && first == failed_region && first != r) continue;
    CW_NEW(made, 1);
    if (first == r) {
      made->tetrahedra = 1000 * (d + 1) + r;
      made->pyramids = 10;
      made->prisms = 500;
      made->failure.failed = d == 0 && r == failed_region;
    }
    snprintf(made->digest, sizeof made->digest, "digest %d of %d", r, d);
    if (d == 1 && r == 0 && damage) snprintf(made->damage, sizeof made->damage, "%s", damage);
    made->quality.open_faces = open_faces[d][r];
    results->bytes[d][r] = made;
    seconds[d][r] = 0.25 * (r + 1);
  }
done:
  return status;
}

static int start_anew(void **state) {
  memset(&run, 0, sizeof run);
  memset(open_faces, 0, sizeof open_faces);
  failed_region = -1;
  damage = NULL;
  shared = thinned = 0;
  run.run_path = "runs/some";
  run.model.domain_count = 2;
  run.domain[0].name = "rotor";
  run.domain[0].images.symmetry = &symmetry;
  run.domain[0].plan = (CwPlan){.region_count = ROTOR, .sector_count = PASSAGES, .sector_region = 1};
  run.domain[1].name = "stator";
  run.domain[1].plan.region_count = STATOR;
  for (int d = 0; d < 2; d++) run.domain[d].plan.predicted_cells = cells[d];
  return 0;
}

static int free_all(void **state) {
  for (int d = 0; d < 2; d++) {
    free(run.summary[d]);
    free(run.region_seconds[d]);
  }
  return 0;
}

static CwStatus make(CwOutcomeKind wanted, CwThinPlaces *places) {
  CwOutcome outcome = {0};
  const CwStatus status = cw_run_regions(&run, places, &outcome);
  assert_int_equal(outcome.kind, wanted);
  return status;
}

static void make_all(void) {
  CwThinPlaces places = {0};
  if (make(CW_OUTCOME_DONE, &places) != CW_OK) fail_msg("%s", cw_fail_message());
  assert_int_equal(places.count, 0);
  assert_int_equal(thinned, 0);
}

// The images of a region wait for it, and cost less than it; each region is made once.
static void images_follow_their_first(void **state) {
  int times[2][ROTOR] = {{0}};
  make_all();
  assert_int_equal(shared, 2);
  assert_int_equal(task_count, TASKS);
  for (int32_t i = 0; i < TASKS; i++) {
    const int32_t first = first_of(&task[i]);
    times[task[i].domain][task[i].index]++;
    if (first == task[i].index) {
      assert_int_equal(after[i], -1);
      assert_near(task[i].cost, cells[task[i].domain][first], 0);
      continue;
    }
    assert_in_range(after[i], 0, i - 1);
    assert_int_equal(task[after[i]].domain, 0);
    assert_int_equal(task[after[i]].index, first);
    assert_true(task[i].cost > 0 && task[i].cost < 0.2 * cells[0][first]);
  }
  for (int32_t r = 0; r < ROTOR; r++) assert_int_equal(times[0][r], 1);
  for (int32_t r = 0; r < STATOR; r++) assert_int_equal(times[1][r], 1);
}

// Of the images all but the digests are those of the first, and their cells count too: also where an attempt before has
// left summaries and a count.
static void images_have_the_summary_of_their_first(void **state) {
  for (int attempt = 0; attempt < 2; attempt++) {
    make_all();
    for (int d = 0; d < 2; d++) {
      for (int32_t r = 0; r < run.domain[d].plan.region_count; r++) {
        char digest[CW_HASH_TEXT];
        const CwMeshTask one = {d, r, 0};
        const CwRegionSummary *summary = &run.summary[d][r];
        snprintf(digest, sizeof digest, "digest %d of %d", r, d);
        assert_int_equal(summary->tetrahedra, 1000 * (d + 1) + first_of(&one));
        assert_int_equal(summary->prisms, 500);
        assert_string_equal(summary->digest, digest);
        assert_near(run.region_seconds[d][r], 0.25 * (r + 1), 0);
      }
    }
    assert_ptr_equal(seconds_of, run.region_seconds);
    // 7 regions of 1000 tetrahedra and more, 3 times 1 and 3 times 2; 2 of 2000, and 1.
    assert_int_equal(run.cells, 7 * 1000 + 3 * 1 + 3 * 2 + 2 * 2000 + 1 + 9 * 510);
    run.summary[0][4].tetrahedra = run.summary[1][0].prisms = 77;
  }
}

// Its images are made in vain; what the others were does not count.
static void a_region_that_fails_asks_for_thinner_layers(void **state) {
  CwThinPlaces places = {0};
  CwRegionSummary summary = {0};
  failed_region = 2;
  open_faces[1][0] = 3; // told of once the regions are whole
  assert_int_equal(make(CW_OUTCOME_THIN, &places), CW_OK);
  assert_int_equal(thinned, 1);
  assert_int_equal(places.count, 1);
  assert_int_equal(run.summary[0][2].failure.failed, 1);
  assert_int_equal(run.summary[0][1].failure.failed, 0);
  assert_int_equal(in_vain(&summary), 0);
  summary.failure.failed = 1;
  assert_int_equal(in_vain(&summary), 1);
  assert_int_equal(make(CW_OUTCOME_THIN, &places), CW_OK);
}

// Faces on planes, one of each sign from either side, add up to nothing, images of regions with them.
static void regions_must_fit_together(void **state) {
  CwThinPlaces places = {0};
  open_faces[0][1] = 5;
  open_faces[0][4] = (uint64_t)-9;
  open_faces[0][6] = 4;
  make_all();
  open_faces[1][0] = 7;
  assert_int_equal(make(CW_OUTCOME_DONE, &places), CW_ERR_MESH);
  assert_string_equal(cw_fail_message(), "stator: its 2 regions in runs/some/mesh do not fit together on the partition "
                                         "planes; allowed: each face there in two of them; remove that folder and run "
                                         "cutwater-mesh again");
  open_faces[1][1] = (uint64_t)-7;
  make_all();
  open_faces[0][6] = 0; // an image
  assert_int_equal(make(CW_OUTCOME_DONE, &places), CW_ERR_MESH);
  cw_fail_clear();
}

// By the first rank alone.
static void damaged_files_are_warned_of(void **state) {
  assert_int_equal(cw_log_open("test", NULL, 0, 0, &run.context.log), CW_OK);
  make_all();
  damage = "runs/some/mesh/stator-0001.h5: is damaged";
  run.rank = 1;
  make_all();
  assert_int_equal(cw_log_warning_count(run.context.log), 0);
  run.rank = 0;
  make_all();
  assert_int_equal(cw_log_warning_count(run.context.log), 1);
  assert_non_null(strstr(cw_log_warning(run.context.log, 0), "stator-0001.h5: is damaged; it is made again"));
  cw_log_close(&run.context.log);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(images_follow_their_first, start_anew, free_all),
      cmocka_unit_test_setup_teardown(images_have_the_summary_of_their_first, start_anew, free_all),
      cmocka_unit_test_setup_teardown(a_region_that_fails_asks_for_thinner_layers, start_anew, free_all),
      cmocka_unit_test_setup_teardown(regions_must_fit_together, start_anew, free_all),
      cmocka_unit_test_setup_teardown(damaged_files_are_warned_of, start_anew, free_all),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
