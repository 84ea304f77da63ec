// SPDX-License-Identifier: AGPL-3.0-or-later
// Which y+ and which first height hold for a wall: by hand.
#include "pipeline/wall_group.h"
#include "tests/unit_test.h"

static const CwPatchGroup group[4] = {CW_GROUP_BLADE, CW_GROUP_HUB_SHROUD, CW_GROUP_VOLUTE, CW_GROUP_PIPE};

// y+ of 1 to 4, one a group, and first heights of 10 to 40.
static CwWalls make(void) {
  CwWalls walls = {.blade = {.y_plus = 1, .first_height = 10},
                   .hub_shroud = {.y_plus = 2, .first_height = 20},
                   .volute = {.y_plus = 3, .first_height = 30},
                   .pipe = {.y_plus = 4, .first_height = 40}};
  return walls;
}

static CwWallGroup *own(CwWalls *walls, int g) {
  CwWallGroup *const groups[4] = {&walls->blade, &walls->hub_shroud, &walls->volute, &walls->pipe};
  return groups[g];
}

static void each_group_is_its_own(void **state) {
  CwWalls walls = make();
  for (int g = 0; g < 4; g++) assert_ptr_equal(cw_wall_group(&walls, group[g]), own(&walls, g));
}

// A patch's own y+ stands in place of y+ and first height of its group, which stays as it is.
static void a_patch_of_its_own(void **state) {
  CwWalls walls = make();
  for (int g = 0; g < 4; g++) {
    CwModelPatch patch = {.group = group[g], .y_plus_asked = NAN, .y_plus = 77};
    CwWallGroup asked = cw_patch_walls(&walls, &patch);
    assert_near(asked.y_plus, g + 1, 0);
    assert_near(asked.first_height, 10 * (g + 1), 0);
    patch.y_plus_asked = 50;
    asked = cw_patch_walls(&walls, &patch);
    assert_near(asked.y_plus, 50, 0);
    assert_true(isnan(asked.first_height));
    assert_near(own(&walls, g)->y_plus, g + 1, 0);
    assert_near(own(&walls, g)->first_height, 10 * (g + 1), 0);
  }
}

// Left open where a group has neither; one of the two is enough.
static void a_first_height_left_open(void **state) {
  for (int given = 0; given < 256; given++) { // two bits a group
    CwWalls walls = make();
    int open = 0;
    for (int g = 0; g < 4; g++) {
      if (!(given >> 2 * g & 1)) own(&walls, g)->y_plus = NAN;
      if (!(given >> 2 * g & 2)) own(&walls, g)->first_height = NAN;
      open |= (given >> 2 * g & 3) == 0;
    }
    assert_int_equal(cw_walls_auto(&walls), open);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_group_is_its_own),
      cmocka_unit_test(a_patch_of_its_own),
      cmocka_unit_test(a_first_height_left_open),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
