// SPDX-License-Identifier: AGPL-3.0-or-later
// Places on polylines, and corners that are one.
#include <stdlib.h>
#include <string.h>

#include "mesher/network/network.h"
#include "tests/unit_test.h"

// From (0, 0, 0) by (3, 0, 0) to (3, 4, 0): lengths 3 and 4.
static void make_bend(CwNetwork *network) {
  CwCurve curve = {.kind = CW_CURVE_LINE};
  assert_int_equal(cw_curve_fine_make(3, &curve), CW_OK);
  curve.fine_x[1][0] = curve.fine_x[2][0] = 3;
  curve.fine_x[2][1] = 4;
  assert_int_equal(cw_network_add_curve(network, &curve), CW_OK);
}

static void lengths_add_up(void **state) {
  CwNetwork network = {0};
  make_bend(&network);
  const double *length = network.curve[0].fine_length;
  assert_near(length[0], 0, 0);
  assert_near(length[1], 3, 0);
  assert_near(length[2], 7, 0);
  cw_network_free(&network);
}

static void a_line_is_followed_by_its_length(void **state) {
  CwNetwork network = {0};
  make_bend(&network);
  // Before and behind it: its ends.
  const double wanted[][3] = {{0, 0, 0}, {1.5, 1.5, 0}, {3, 3, 0}, {5, 3, 2}, {7, 3, 4}, {9, 3, 4}, {-1, 0, 0}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    double x[3], parameter[2];
    cw_curve_point(&network, &network.curve[0], wanted[i][0], x, parameter);
    assert_near(x[0], wanted[i][1], 1e-15);
    assert_near(x[1], wanted[i][2], 1e-15);
    assert_near(x[2], 0, 0);
  }
  cw_network_free(&network);
}

static void the_nearest_place_is_found(void **state) {
  CwNetwork network = {0};
  make_bend(&network);
  const double place[][4] = {{1, 2, 0, 1},     {-5, 1, 0, 0}, {4, -1, 0, 3},  {2.5, 1, 7, 4},
                             {9, 2.5, 1, 5.5}, {3, 9, 0, 7},  {1, 0.4, 0, 1}, {2.9, 3, 0, 6}};
  for (size_t i = 0; i < sizeof place / sizeof *place; i++)
    assert_near(cw_curve_nearest(&network.curve[0], place[i]), place[i][3], 1e-15);
  cw_network_free(&network);
}

// Corners are one where they lie on the same things at the same place.
static void corners_are_told_apart(void **state) {
  CwNetwork network = {0};
  const CwCorner first = {.x = {1, 2, 3}, .face = -1, .edge = 4, .t = 0.5, .vertex = -1, .plane = {2, -1, -1}};
  CwCorner corner[5] = {first, first, first, first, first};
  int32_t number;
  corner[1].x[2] += 1e-9;
  corner[2].x[2] += 1e-7;
  corner[3].edge = 5;
  corner[4].plane[1] = 3;
  const int32_t wanted[5] = {0, 0, 1, 2, 3};
  for (int i = 0; i < 5; i++) {
    assert_int_equal(cw_network_corner(&network, &corner[i], cw_same_corner, &number), CW_OK);
    assert_int_equal(number, wanted[i]);
  }
  assert_int_equal(network.corner_count, 4);
  assert_near(network.corner[0].x[2], 3, 0);
  cw_network_free(&network);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lengths_add_up),
      cmocka_unit_test(a_line_is_followed_by_its_length),
      cmocka_unit_test(the_nearest_place_is_found),
      cmocka_unit_test(corners_are_told_apart),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
