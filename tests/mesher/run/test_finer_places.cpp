// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <cstdlib>

#include "filleted_step.h"

extern "C" {
#include "mesher/cad/symmetry.h"
#include "mesher/run/finer_places.h"
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

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(places_ask_for_half)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
