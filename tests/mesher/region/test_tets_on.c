// SPDX-License-Identifier: AGPL-3.0-or-later

#include "mesher/region/tets_on.h"
#include "tests/unit_test.h"

// Two tetrahedra on both sides of triangle 1 2 3, and a third apart from them.
static const int32_t tet[3][4] = {{0, 1, 2, 3}, {4, 3, 2, 1}, {5, 6, 7, 8}};

static void each_triangle_has_its_tetrahedron(void **state) {
  const int32_t triangle[4][3] = {{3, 0, 1}, {2, 4, 3}, {8, 7, 6}, {0, 1, 2}};
  const int32_t wanted[4] = {0, 1, 2, 0};
  int32_t on[4];
  assert_int_equal(cw_tets_on(9, 4, triangle, 3, tet, on), CW_OK);
  for (int t = 0; t < 4; t++) assert_int_equal(on[t], wanted[t]);
}

static void of_two_the_later_and_of_none_none(void **state) {
  const int32_t triangle[3][3] = {{2, 1, 3}, {0, 1, 4}, {5, 6, 0}};
  int32_t on[3];
  assert_int_equal(cw_tets_on(9, 3, triangle, 3, tet, on), CW_OK);
  assert_int_equal(on[0], 1);
  assert_int_equal(on[1], -1);
  assert_int_equal(on[2], -1);
}

static void without_triangles_or_tetrahedra(void **state) {
  const int32_t triangle[1][3] = {{0, 1, 2}};
  int32_t on[1] = {7};
  assert_int_equal(cw_tets_on(9, 0, triangle, 3, tet, on), CW_OK);
  assert_int_equal(on[0], 7);
  assert_int_equal(cw_tets_on(9, 1, triangle, 0, tet, on), CW_OK);
  assert_int_equal(on[0], -1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_triangle_has_its_tetrahedron),
      cmocka_unit_test(of_two_the_later_and_of_none_none),
      cmocka_unit_test(without_triangles_or_tetrahedra),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
