// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "filleted_step.h"

extern "C" {
#include "mesher/cad/symmetry.h"
#include "mesher/policy.h"
#include "mesher/run/finer_places.h"
#include "mesher/run/poor_places.h"
}

#include "planned_solid.h"

// A place asks for half of the edges that are there, at scale 1, and so do its images; those of other domains are
// theirs.
static void places_ask_for_half(void **) {
  PlannedSolid solid(filleted_step(false));
  CwDomain domain = {};
  CwSymmetry symmetry = {};
  CwFinerPlaces places = {};
  const double x[3] = {3e-3, 1e-3, 2e-3};
  symmetry.count = 4;
  domain.size = solid.size;
  cw_size_set_scale(solid.size, 1);
  const double wanted = cw_size_at(solid.size, x);
  cw_size_set_scale(solid.size, 3);
  assert_int_equal(cw_finer_places_add(&domain, 1, x, &places), CW_OK);
  assert_int_equal(places.count, 1);
  domain.symmetry = &symmetry;
  assert_int_equal(cw_finer_places_add(&domain, 0, x, &places), CW_OK);
  assert_int_equal(places.count, 5);
  for (int d = 0; d < 2; d++) {
    int32_t count;
    CwSizePoint *point = nullptr;
    assert_int_equal(cw_finer_places_of(&places, d, &count, &point), CW_OK);
    assert_int_equal(count, d == 0 ? 4 : 1);
    for (int i = 0; i < count; i++) {
      const double turned[4][2] = {{x[0], x[1]}, {-x[1], x[0]}, {-x[0], -x[1]}, {x[1], -x[0]}};
      assert_near(point[i].size, wanted / 2, 1e-9 * wanted);
      assert_near(std::fabs(point[i].x[0] - turned[i][0]) + std::fabs(point[i].x[1] - turned[i][1]), 0, 1e-15);
      assert_near(point[i].x[2], x[2], 0);
    }
    std::free(point);
  }
  cw_finer_places_free(&places);
  assert_int_equal(places.count, 0);
}

// Columns within an edge of a place and its images are pinched, twice as far where a place of before is near; none of
// them asks for shorter edges.
static void places_are_pinched(void **) {
  PlannedSolid solid(filleted_step(false));
  CwSymmetry symmetry = {};
  CwDomain domain = {};
  CwFinerPlaces places = {};
  CwSizePoint *point = nullptr;
  const double x[3] = {2e-3, 1e-3, 3e-3};
  int32_t count;
  symmetry.count = 2;
  domain.size = solid.size;
  domain.symmetry = &symmetry;
  cw_size_set_scale(solid.size, 0.02);
  const double edge = cw_size_at(solid.size, x), near[3] = {x[0], x[1] + 1.5 * edge, x[2]};
  const double far[3] = {x[0], x[1] + 5 * edge, x[2]};
  check(cw_finer_places_add_pinched(&domain, 1, x, 0, &places));
  check(cw_finer_places_add_pinched(&domain, 1, x, 0, &places)); // of the same round
  assert_int_equal(places.count, 4);
  for (int i = 0; i < 4; i++) {
    assert_int_equal(places.place[i].domain, 1);
    assert_int_equal(places.place[i].pinched, 1);
    assert_near(places.place[i].point.x[0], i % 2 ? -x[0] : x[0], 1e-15);
    assert_near(places.place[i].point.size, edge, 0);
  }
  domain.symmetry = nullptr;
  check(cw_finer_places_add_pinched(&domain, 1, near, 4, &places));
  check(cw_finer_places_add_pinched(&domain, 1, near, 5, &places));
  check(cw_finer_places_add_pinched(&domain, 1, far, 4, &places));
  check(cw_finer_places_add_pinched(&domain, 0, near, 7, &places));
  assert_near(places.place[4].point.size, 2 * edge, 0);
  assert_near(places.place[5].point.size, 4 * edge, 0);
  assert_near(places.place[6].point.size, cw_size_at(solid.size, far), 0);
  assert_near(places.place[7].point.size, cw_size_at(solid.size, near), 0);
  for (int d = 0; d < 2; d++) {
    check(cw_finer_places_of(&places, d, &count, &point));
    assert_int_equal(count, 0);
    std::free(point);
  }
  cw_finer_places_free(&places);
}

// Of two regions with places at 11, 15.9 and 17 degrees only the one that is flat asks for shorter edges: at the flat
// place and at the nearly flat one, below 4/3 of what is wanted. Of places that are near the first alone does.
static void flat_regions_ask_where_they_are_nearly_flat(void **) {
  static CwMeshRun run;
  PlannedSolid solid(filleted_step(false));
  CwRegionSummary made[2] = {};
  cw_size_set_scale(solid.size, 0.02);
  const double apart = 3 * cw_size_at(solid.size, (const double[]){1e-3, 1e-3, 1e-3});
  for (int r = 0; r < 2; r++) {
    made[r].dihedral_allowed = 40;
    made[r].quality.flat_count = 4;
    for (int i = 0; i < 4; i++) {
      const double flatness[] = {11, 11.5, 15.9, 17}, at[] = {0, 0.1, 1, 2};
      made[r].quality.flat[i] = {{1e-3 + at[i] * apart, 1e-3 + 5 * r * apart, 1e-3}, flatness[i]};
    }
    made[r].quality.flattest = r == 0 ? 11 : cw_policy.flat_angle;
  }
  run.model.domain_count = 1;
  run.domain[0].size = solid.size;
  run.domain[0].plan.region_count = 2;
  run.summary[0] = made;
  assert_int_equal(cw_finer_at_poor(&run), CW_OK);
  assert_int_equal(run.finer.count, 2);
  for (int i = 0; i < 2; i++) assert_near(run.finer.place[i].point.x[0], 1e-3 + i * apart, 1e-15);
  cw_finer_places_free(&run.finer);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(places_ask_for_half), cmocka_unit_test(places_are_pinched),
                              cmocka_unit_test(flat_regions_ask_where_they_are_nearly_flat)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
