// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/run/run_thinning.h"
#include "tests/unit_test.h"

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
  assert_string_equal(
      outcome.reason,
      "stator region 3, no place is known: the boundary crosses itself; after 3 attempts with thinner "
      "layers, at last within 16 edge lengths; its boundary is in runs/some/mesh/failed-stator-0003.vtk");
  assert_int_equal(run.retries, 0);
}

// Columns that leave no room on a plane are told of as being there.
static void places_on_planes_are_called_so(void **state) {
  static CwMeshRun run;
  double tight[1][3] = {{1, 2, 3}};
  CwThinPlaces places = {0};
  CwOutcome why = {.kind = CW_OUTCOME_THIN, .domain = 1, .reason = "two cuts cross"};
  run.domain[1].free_curves.tight_count = 1;
  run.domain[1].free_curves.tight = tight;
  assert_int_equal(cw_thin_places_on_planes(&run, &why, &places), CW_OK);
  assert_int_equal(places.count, 1);
  assert_int_equal(places.place[0].domain, 1);
  assert_int_equal(places.place[0].region, -1);
  assert_string_equal(places.place[0].failure.patch, "partition plane");
  assert_string_equal(places.place[0].failure.message, "two cuts cross");
  assert_near(places.place[0].failure.at[2], 3, 0);
  cw_thin_places_free(&places);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_plan_is_given_up_after_three_attempts),
      cmocka_unit_test(places_on_planes_are_called_so),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
