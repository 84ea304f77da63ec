// SPDX-License-Identifier: AGPL-3.0-or-later
// Planes weighed against one another.
extern "C" {
#include "mesher/plan/plan_cost.h"
}

#include "solids.h"

// A wedge of 40 degrees holds two tetrahedra of the 20 wanted. Half of the way from a right angle costs a quarter.
static void a_sharp_angle_is_a_fault(void **) {
  const double sharp = std::sin(40 * M_PI / 180);
  assert_near(cw_plan_sharpness(1), 0, 1e-12);
  assert_near(cw_plan_sharpness(sharp), CW_PLAN_FAULT, 1e-12);
  assert_near(cw_plan_sharpness((1 + sharp) / 2), 0.25 * CW_PLAN_FAULT, 1e-12);
  assert_true(cw_plan_is_sharp(std::sin(39.9 * M_PI / 180)));
  assert_false(cw_plan_is_sharp(std::sin(40.1 * M_PI / 180)));
}

static void layers_cut_along_an_edge_are_a_fault(void **) {
  for (double sine : {1.0, 0.8, 0.4}) {
    assert_near(cw_plan_place_cost({sine, 0}), cw_plan_sharpness(sine), 1e-12);
    assert_near(cw_plan_place_cost({sine, 1}), cw_plan_sharpness(sine) + CW_PLAN_FAULT, 1e-12);
  }
}

// The cosine of a column to the normals of its wall is at least 0.3: along a wall that the plane grazes at less none
// can stand in it.
static void a_plane_that_holds_no_column_is_unfit(void **) {
  assert_true(cw_plan_place_cost({0.31, 0}) < CW_PLAN_UNFIT);
  for (double sine : {0.0, 0.1, 0.29}) assert_true(cw_plan_place_cost({sine, 0}) >= CW_PLAN_UNFIT);
}

// Triangles between a cut and an edge are as flat as they are low for the room that triangles want.
static void a_cut_beside_an_edge_costs_as_a_sharp_angle(void **) {
  for (double room : {0.0, 0.1, 0.5, 0.9, 1.0})
    assert_near(cw_plan_touch_cost(1 - room), cw_plan_sharpness(room), 1e-12);
  assert_true(cw_plan_touch_cost(CW_PLAN_UNFIT) >= CW_PLAN_UNFIT);
}

// To either side alike, as the square; a part costs what its regions cost if they share its work evenly.
static void uneven_work_costs(void **) {
  assert_near(cw_plan_unevenness(3, 3, 1), 0, 1e-12);
  assert_near(cw_plan_unevenness(1.15, 1, 1), CW_PLAN_FAULT, 1e-9);
  assert_near(cw_plan_unevenness(0.85, 1, 1), CW_PLAN_FAULT, 1e-9);
  assert_near(cw_plan_unevenness(2.6, 2, 1), 4 * CW_PLAN_FAULT, 1e-9);
  for (int regions : {2, 5, 16}) {
    double work = 1.07 * regions;
    assert_near(cw_plan_unevenness(work, regions, regions), regions * cw_plan_unevenness(1.07, 1, 1), 1e-9);
  }
}

// The slice before the impeller may be as small as it likes: then its plane can stand before the blades.
static void only_large_slices_cost(void **) {
  for (double work : {1e-3, 0.5, 0.9, 1.0}) assert_near(cw_plan_slice_cost(2 * work, 2), 0, 0);
  for (double work : {1.05, 1.2, 2.0})
    assert_near(cw_plan_slice_cost(2 * work, 2), cw_plan_unevenness(work, 1, 1), 1e-9);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_sharp_angle_is_a_fault),
      cmocka_unit_test(layers_cut_along_an_edge_are_a_fault),
      cmocka_unit_test(a_plane_that_holds_no_column_is_unfit),
      cmocka_unit_test(a_cut_beside_an_edge_costs_as_a_sharp_angle),
      cmocka_unit_test(uneven_work_costs),
      cmocka_unit_test(only_large_slices_cost),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
