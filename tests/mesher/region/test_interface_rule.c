// SPDX-License-Identifier: AGPL-3.0-or-later
// Who owns an interface, and who refines it. test_boundary refines those of a box, test_region_copy those of a wheel.
#include "mesher/boundary/free_curves.h"
#include "mesher/region/interface_rule.h"
#include "tests/unit_test.h"

// One outline after the other, of one triangle each.
typedef struct {
  CwInterfaceOutline outline[3];
  CwInterfaces interfaces;
  CwSymmetry symmetry;
  CwPeriodicImages images;
  CwPlan plan;
  CwBoundaryInput in;
  CwRegionInput from;
} Rule;

static int32_t none[3][3];

static void make(Rule *rule, int outlines, int32_t (*region)[2]) {
  *rule = (Rule){.symmetry = {.count = 3}};
  for (int32_t i = 0; i < outlines; i++) rule->outline[i].triangle_start = i;
  rule->interfaces.outline_count = outlines;
  rule->interfaces.outline = rule->outline;
  rule->interfaces.refined = (CwInterfaceTriangles){outlines, none, region};
  rule->in.images = &rule->images;
  rule->in.plan = &rule->plan;
  rule->from.in = &rule->in;
  rule->from.interfaces = &rule->interfaces;
}

// The lower number owns, whichever side it lies on.
static void the_lower_number_owns(void **state) {
  int32_t region[2][2] = {{0, 1}, {2, 1}}, planned[2][2] = {{1, 2}, {0, 2}};
  const int32_t number[3] = {2, 1, 3};
  Rule rule;
  make(&rule, 2, region);
  for (int i = 0; i < 2; i++) {
    assert_int_equal(cw_interface_owner(&rule.from, number, i), 1);
    assert_int_equal(cw_interface_refiner(&rule.from, number, i), 1);
  }
  const int32_t other[3] = {1, 3, 2};
  assert_int_equal(cw_interface_owner(&rule.from, other, 0), 0);
  assert_int_equal(cw_interface_owner(&rule.from, other, 1), 2);
  // Once interfaces are refined it is the planned ones that tell.
  rule.interfaces.planned = (CwInterfaceTriangles){2, none, planned};
  assert_int_equal(cw_interface_owner(&rule.from, number, 0), 1);
  assert_int_equal(cw_interface_owner(&rule.from, number, 1), 0);
}

// A hub, region 0, and three passages of two regions each: 1 2, 3 4, 5 6. Numbers of the first passage count, so that
// turns take owners to owners; only the first of three images is refined. Two images of one region have the same
// number: the one behind the plane owns.
static void turns_take_owners_to_owners(void **state) {
  const int32_t number[7] = {3, 2, 1, 7, 6, 5, 4};
  int32_t within[3][2] = {{1, 2}, {3, 4}, {5, 6}}, between[3][2] = {{1, 3}, {3, 5}, {5, 1}};
  int32_t turns[3] = {0, 1, 2};
  Rule rule;
  for (int seams = 0; seams < 2; seams++) {
    make(&rule, 3, seams ? between : within);
    rule.images.symmetry = &rule.symmetry;
    rule.plan.sector_region = 1;
    rule.plan.region_count = 7;
    rule.interfaces.outline_images.turns = turns;
    for (int i = 0; i < 3; i++) {
      assert_int_equal(cw_interface_owner(&rule.from, number, i), seams ? 1 + 2 * i : 2 + 2 * i);
      assert_int_equal(cw_interface_refiner(&rule.from, number, i), i ? -1 : seams ? 1 : 2);
    }
  }
}

// The hub lies beside all images of a passage, and owns each of its interfaces: the first is refined by it, the others
// are images of that.
static void the_hub_refines_the_first_image_alone(void **state) {
  const int32_t number[7] = {1, 2, 3, 4, 5, 6, 7};
  int32_t region[3][2] = {{0, 1}, {0, 3}, {0, 5}}, turns[3] = {0, 1, 2};
  Rule rule;
  make(&rule, 3, region);
  rule.images.symmetry = &rule.symmetry;
  rule.plan.sector_region = 1;
  rule.plan.region_count = 7;
  rule.interfaces.outline_images.turns = turns;
  for (int i = 0; i < 3; i++) {
    assert_int_equal(cw_interface_owner(&rule.from, number, i), 0);
    assert_int_equal(cw_interface_refiner(&rule.from, number, i), i ? -1 : 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_lower_number_owns),
      cmocka_unit_test(turns_take_owners_to_owners),
      cmocka_unit_test(the_hub_refines_the_first_image_alone),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
