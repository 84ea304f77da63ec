// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/bisection.h"

#include "tests/draw.h"
#include "tests/unit_test.h"

// A box of 4 x 2 x 1 points, out of order, in four groups of two: halved along x, then again along x, as a half is 1
// long in x and in y and the first of the longest extents counts.
static void a_box_is_halved_along_its_longest_extent(void **state) {
  static const double points[8][3] = {{3, 0, 0}, {0, 1, 0}, {2, 1, 0}, {1, 0, 0},
                                      {0, 0, 0}, {3, 1, 0}, {1, 1, 0}, {2, 0, 0}};
  static const int64_t sizes[] = {2, 2, 2, 2};
  int32_t order[8], group[8];
  cw_bisection(points, 8, sizes, 4, order, group);
  for (int i = 0; i < 8; ++i) assert_int_equal(group[i], (int)points[i][0]);
}

// Points at one plane go by their index; sizes are met exactly.
static void equal_points_go_by_their_index(void **state) {
  enum { COUNT = 1000 };
  static double points[COUNT][3];
  static const int64_t sizes[] = {1, 499, 300, 200};
  int32_t order[COUNT], group[COUNT];
  for (int i = 0; i < COUNT; ++i) points[i][0] = points[i][1] = points[i][2] = 7;
  cw_bisection((const double(*)[3])points, COUNT, sizes, 4, order, group);
  for (int i = 0; i < COUNT; ++i) assert_int_equal(group[i], i < 1 ? 0 : i < 500 ? 1 : i < 800 ? 2 : 3);
}

// Of pseudo-random points every one of a group lies before those of the next: two groups, one plane.
static void two_groups_have_a_plane_between_them(void **state) {
  enum { COUNT = 5000 };
  static double points[COUNT][3];
  int32_t order[COUNT], group[COUNT];
  uint64_t seed = 1;
  for (int i = 0; i < COUNT; ++i)
    for (int k = 0; k < 3; ++k) points[i][k] = draw(&seed) * (k == 1 ? 3 : 1);
  const int64_t sizes[] = {1234, COUNT - 1234};
  cw_bisection((const double(*)[3])points, COUNT, sizes, 2, order, group);
  double last = -1, first = 9;
  int count = 0;
  for (int i = 0; i < COUNT; ++i) {
    count += group[i] == 0;
    if (group[i] == 0 && points[i][1] > last) last = points[i][1];
    if (group[i] == 1 && points[i][1] < first) first = points[i][1];
  }
  assert_int_equal(count, 1234);
  assert_true(last <= first);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_box_is_halved_along_its_longest_extent),
      cmocka_unit_test(equal_points_go_by_their_index),
      cmocka_unit_test(two_groups_have_a_plane_between_them),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
