// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include "mesher/run/poor_places.h"
#include "tests/unit_test.h"

// Of five regions one has half of the 12 degrees that are asked, one a third of the 9 that its boundary allows; one is
// as flat as its boundary asks, two have what is asked.
static void what_lacks_angle_counts(void **state) {
  static CwMeshRun run = {.model.domain_count = 1};
  CwRegionSummary made[5] = {0};
  const double least[5] = {30, 6, 9, 12, 3}, allowed[5] = {40, 40, 9, 40, 9};
  int32_t count;
  for (int r = 0; r < 5; r++) {
    made[r].quality.flattest = least[r];
    made[r].dihedral_allowed = allowed[r];
  }
  run.domain[0].plan.region_count = 5;
  run.summary[0] = made;
  assert_near(cw_poor_deficit(&run, &count), 1. / 2 + 2. / 3, 1e-12);
  assert_int_equal(count, 2);
  made[1].quality.flattest = 12;
  made[4].dihedral_allowed = 3;
  assert_near(cw_poor_deficit(&run, &count), 0, 0);
  assert_int_equal(count, 0);
}

// Of three patches the first is no wall, and the last is told of beforehand. Of 1000 faces of the second, in two
// regions, 10 may miss their first height; where 25 do it lacks one and a half times as many.
static void missed_first_heights_count(void **state) {
  static CwMeshRun run = {.model.domain_count = 1};
  CwModelPatch patch[3] = {{.kind = CW_PATCH_INLET}, {.kind = CW_PATCH_WALL}, {.kind = CW_PATCH_WALL}};
  CwPatchTarget target[3];
  CwRegionSummary made[2] = {0};
  int32_t count;
  run.model.domain[0].patch_count = 3;
  run.domain[0].patch = patch;
  run.domain[0].patch_target = target;
  run.domain[0].plan.region_count = 2;
  run.summary[0] = made;
  memset(target, 0, sizeof target);
  target[2].first.source = CW_FIRST_FITTED;
  for (int r = 0; r < 2; r++) {
    made[r].quality.flattest = made[r].dihedral_allowed = 20;
    made[r].coverage[1] = (CwLayerCoverage){.faces = 500, .first_met = r == 0 ? 475 : 500};
    made[r].coverage[2] = (CwLayerCoverage){.faces = 500};
  }
  assert_near(cw_poor_deficit(&run, &count), 1.5, 1e-12);
  assert_int_equal(count, 1);
  // 15 of them beside a sharp edge are told of, where there is one; else the mesh is too coarse for a round one.
  made[0].coverage[1].missed[CW_LAYER_SHARPNESS] = 15;
  run.domain[0].sharp.angle = 90;
  assert_near(cw_poor_deficit(&run, &count), 1.5, 1e-12);
  run.domain[0].sharp.angle = 20;
  assert_near(cw_poor_deficit(&run, &count), 0, 0);
  run.domain[0].sharp.angle = 180;
  made[0].coverage[1].first_met = 490;
  assert_near(cw_poor_deficit(&run, &count), 0, 0);
  assert_int_equal(count, 0);
}

// Two domains, each of a region with half of its angle; then one of them with all of it.
static void domains_that_lack_are_told(void **state) {
  static CwMeshRun run = {.model.domain_count = 2};
  CwRegionSummary made[2] = {0};
  int32_t count, lacks[CW_DOMAINS_MOST];
  for (int d = 0; d < 2; d++) {
    made[d].quality.flattest = 6;
    made[d].dihedral_allowed = 12;
    run.domain[d].plan.region_count = 1;
    run.summary[d] = &made[d];
  }
  cw_poor_domains(&run, lacks);
  assert_int_equal(lacks[0], 1);
  assert_int_equal(lacks[1], 1);
  assert_near(cw_poor_deficit(&run, &count), 1, 1e-12);
  assert_int_equal(count, 2);
  made[0].quality.flattest = 12;
  cw_poor_domains(&run, lacks);
  assert_int_equal(lacks[0], 0);
  assert_int_equal(lacks[1], 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_lacks_angle_counts),
                                     cmocka_unit_test(missed_first_heights_count),
                                     cmocka_unit_test(domains_that_lack_are_told)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
