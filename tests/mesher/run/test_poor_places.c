// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "mesher/run/poor_places.h"

// Of five regions one has half of the 12 degrees that are asked, one a third of the 9 that its boundary allows; one is
// as flat as its boundary asks, two have what is asked.
static void what_lacks_angle_counts(void **state) {
  static CwMeshRun run = {.model.domain_count = 1};
  CwRegionSummary made[5] = {0};
  const double least[5] = {30, 6, 9, 12, 3}, allowed[5] = {40, 40, 9, 40, 9};
  int32_t count;
  for (int r = 0; r < 5; r++) {
    made[r].quality.dihedral_least = least[r];
    made[r].dihedral_allowed = allowed[r];
  }
  run.domain[0].plan.region_count = 5;
  run.summary[0] = made;
  assert_float_equal(cw_poor_deficit(&run, &count), 1. / 2 + 2. / 3, 1e-12);
  assert_int_equal(count, 2);
  made[1].quality.dihedral_least = 12;
  made[4].dihedral_allowed = 3;
  assert_float_equal(cw_poor_deficit(&run, &count), 0, 0);
  assert_int_equal(count, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_lacks_angle_counts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
