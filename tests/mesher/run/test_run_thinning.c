// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mesher/run/run_thinning.h"

// After three attempts with thinner layers the domain of the first place gets another plan.
static void a_plan_is_given_up_after_three_attempts(void **state) {
  static CwMeshRun run = {.run_path = "runs/some"};
  CwThinPlace place = {.domain = 1, .region = 2, .failure = {.failed = 1, .everywhere = 1}};
  CwThinPlaces places = {.count = 1, .place = &place};
  CwOutcome outcome = {0};
  run.domain[1].name = "stator";
  snprintf(place.failure.message, sizeof place.failure.message, "the boundary crosses itself");
  assert_int_equal(cw_thin(&run, &places, 3, &outcome), CW_OK);
  assert_int_equal(outcome.kind, CW_OUTCOME_REPLAN);
  assert_int_equal(outcome.domain, 1);
  assert_string_equal(outcome.reason,
                      "stator region 3, no place is known: the boundary crosses itself; after 3 attempts with thinner "
                      "layers; its boundary is in runs/some/mesh/failed-stator-0003.vtk");
  assert_int_equal(run.retries, 0);
}

// Of four regions one is flat, and one as flat as its boundary asks.
static void flat_tetrahedra_are_places(void **state) {
  static CwMeshRun run = {.model.domain_count = 1};
  CwRegionSummary made[4] = {0};
  CwThinPlaces places = {0};
  double deficit;
  const double least[4] = {30, 6, 9, 12}, allowed[4] = {40, 40, 9, 40};
  for (int r = 0; r < 4; r++) {
    made[r].quality.dihedral_least = least[r];
    made[r].dihedral_allowed = allowed[r];
    made[r].quality.flattest_at[1] = r;
  }
  run.domain[0].plan.region_count = 4;
  run.summary[0] = made;
  assert_int_equal(cw_thin_places_flat(&run, &places, &deficit), CW_OK);
  assert_int_equal(places.count, 1);
  assert_int_equal(places.place[0].region, 1);
  assert_float_equal(places.place[0].failure.at[1], 1, 0);
  assert_float_equal(deficit, 0.5, 1e-12);
  cw_thin_places_free(&places);
  run.summary[0] = NULL;
}

// What is thinned after the copy is forgotten when the copy is taken back.
static void thinning_is_taken_back(void **state) {
  static CwMeshRun run = {.model.domain_count = 2};
  double *copy[CW_DOMAINS_MOST] = {0};
  run.domain[0].surface.vertex_count = run.domain[1].surface.vertex_count = 1;
  run.most_thickness[0] = malloc(sizeof(double));
  run.most_thickness[0][0] = 3;
  assert_int_equal(cw_thinning_copy(&run, copy), CW_OK);
  run.most_thickness[0][0] = 2;
  run.most_thickness[1] = malloc(sizeof(double));
  cw_thinning_take_back(&run, copy);
  assert_float_equal(run.most_thickness[0][0], 3, 0);
  assert_null(run.most_thickness[1]);
  assert_null(copy[0]);
  cw_end_thinning(&run);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_plan_is_given_up_after_three_attempts),
      cmocka_unit_test(flat_tetrahedra_are_places),
      cmocka_unit_test(thinning_is_taken_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
