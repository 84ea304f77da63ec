// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>

#include "mesher/common/intersect.h"
#include "surfaces.h"
#include "tests/unit_test.h"

static int32_t pairs(int32_t points, const double (*x)[3], int32_t triangles, const int32_t (*t)[3], int32_t first[2]) {
  int32_t count = -1, (*pair)[2] = NULL;
  assert_int_equal(cw_self_intersections(points, x, triangles, t, &count, &pair), CW_OK);
  if (count > 0 && first) first[0] = pair[0][0], first[1] = pair[0][1];
  for (int32_t i = 1; i < count; i++)
    assert_true(pair[i - 1][0] < pair[i][0] || (pair[i - 1][0] == pair[i][0] && pair[i - 1][1] < pair[i][1]));
  free(pair);
  return count;
}

static void crossing_pair(void **state) {
  const double x[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}};
  const int32_t t[2][3] = {{0, 1, 2}, {3, 4, 5}};
  int32_t first[2];
  assert_int_equal(pairs(6, x, 2, t, first), 1);
  assert_int_equal(first[0], 0);
  assert_int_equal(first[1], 1);
}

static void apart_by_little(void **state) {
  const double x[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-15}, {1, 0, 1e-15}, {0, 1, 1e-15}};
  const int32_t t[2][3] = {{0, 1, 2}, {3, 4, 5}};
  assert_int_equal(pairs(6, x, 2, t, NULL), 0);
}

static void touching_counts(void **state) { // a corner on the other's face, not shared by index
  const double x[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 0}, {1, 1, 1}, {0, 1, 1}};
  const int32_t t[2][3] = {{0, 1, 2}, {3, 4, 5}};
  assert_int_equal(pairs(6, x, 2, t, NULL), 1);
}

static void neighbours(void **state) {
  // Over a common edge: open, folded flat onto each other, and over a common corner with the opposite edge piercing.
  const double x[7][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.2, 0.3, 0}, {0.4, 0.3, -1}, {0.4, 0.3, 1}};
  const int32_t open[2][3] = {{0, 1, 2}, {1, 3, 2}}, folded[2][3] = {{0, 1, 2}, {0, 1, 4}};
  const int32_t pierced[2][3] = {{0, 1, 2}, {0, 5, 6}}, corner[2][3] = {{0, 1, 2}, {2, 5, 6}};
  assert_int_equal(pairs(7, x, 2, open, NULL), 0);
  assert_int_equal(pairs(7, x, 2, folded, NULL), 1);
  assert_int_equal(pairs(7, x, 2, pierced, NULL), 1);
  assert_int_equal(pairs(7, x, 2, corner, NULL), 1);
}

static void doubled_and_flat(void **state) {
  const double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, y[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const int32_t flat[1][3] = {{0, 1, 2}}, doubled[2][3] = {{0, 1, 2}, {2, 1, 0}};
  int32_t first[2];
  assert_int_equal(pairs(3, x, 1, flat, first), 1);
  assert_int_equal(first[0], first[1]);
  assert_int_equal(pairs(3, y, 2, doubled, NULL), 1);
}

// Two boxes, one shifted into the other's corner: the crossing is found; moved apart it is gone.
static void boxes(void **state) {
  for (int apart = 0; apart < 2; apart++) {
    Surface s = {0};
    double low[3] = {0, 0, 0}, high[3] = {0.01, 0.01, 0.01}, a = apart ? 0.0101 : 0.0083;
    double low2[3] = {a, a, a}, high2[3] = {a + 0.01, a + 0.01, a + 0.01};
    surface_box(&s, low, high, 0.0005, 63, 0);
    surface_box(&s, low2, high2, 0.0005, 63, 0);
    surface_weld(&s);
    int32_t count =
        pairs(s.point_count, (const double(*)[3])s.x, s.triangle_count, (const int32_t(*)[3])s.triangle, NULL);
    if (apart)
      assert_int_equal(count, 0);
    else
      assert_true(count >= 6 * 3); // six crossing lines of 1.7 mm over triangles of 0.5 mm
    surface_free(&s);
  }
}

static void wrong_input(void **state) {
  const double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}};
  const int32_t good[1][3] = {{0, 1, 2}}, bad[1][3] = {{0, 1, 3}};
  int32_t count, (*pair)[2];
  assert_int_equal(cw_self_intersections(3, x, 1, good, &count, &pair), CW_ERR_INPUT);
  assert_int_equal(cw_self_intersections(3, x, 1, bad, &count, &pair), CW_ERR_INPUT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(crossing_pair), cmocka_unit_test(apart_by_little),  cmocka_unit_test(touching_counts),
      cmocka_unit_test(neighbours),    cmocka_unit_test(doubled_and_flat), cmocka_unit_test(boxes),
      cmocka_unit_test(wrong_input),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
