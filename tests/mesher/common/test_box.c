// SPDX-License-Identifier: AGPL-3.0-or-later
// Boxes of points and triangles, and which meet.
#include <string.h>

#include "mesher/common/box.h"
#include "tests/unit_test.h"

static const double POINT[4][3] = {{1, -2, 0.5}, {-3, 4, 0.25}, {0, 1, 0.75}, {2, 0, 0.5}};
static const CwBox ALL = {{-3, -2, 0.25}, {2, 4, 0.75}};

static void check_same(const CwBox *a, const CwBox *b) {
  assert_memory_equal(a, b, sizeof *a);
}

static void holds_all_points(void **state) {
  CwBox box = cw_box_of_points(4, POINT);
  check_same(&box, &ALL);
  assert_true(cw_box_longest(&box) == 6);
  CwBox sum = cw_box_of_triangle(POINT[0], POINT[1], POINT[2]), last = cw_box_of_point(POINT[3]);
  assert_true(sum.high[0] == 1);
  cw_box_add(&sum, &last);
  check_same(&sum, &ALL);
}

static void of_nothing(void **state) {
  CwBox box = cw_box_of_points(0, NULL), all = ALL;
  assert_true(cw_box_longest(&box) == 0);
  assert_false(cw_boxes_meet(&box, &ALL));
  cw_box_add(&all, &box);
  check_same(&all, &ALL);
  cw_box_add(&box, &ALL);
  check_same(&box, &ALL);
}

static void those_that_touch_meet(void **state) {
  for (int k = 0; k < 3; k++) {
    CwBox beside = ALL;
    double side = ALL.high[k] - ALL.low[k];
    beside.low[k] += side, beside.high[k] += side;
    assert_true(cw_boxes_meet(&ALL, &beside) && cw_boxes_meet(&beside, &ALL));
    beside.low[k] += 0.125;
    assert_false(cw_boxes_meet(&ALL, &beside) || cw_boxes_meet(&beside, &ALL));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(holds_all_points),
      cmocka_unit_test(of_nothing),
      cmocka_unit_test(those_that_touch_meet),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
