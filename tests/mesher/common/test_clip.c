// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include "mesher/common/clip.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static void assert_point(const double *x, double a, double b) {
  assert_near(x[0], a, 1e-12);
  assert_near(x[1], b, 1e-12);
}

// The paper's figure 1: triangle {1, 2, 3} through the clippers left, right, lower, upper of a window gives
// {2', 3, 3', 3''}. Here the window is the unit square; the marked points are worked by hand.
static void worked_example_of_the_paper(void **state) {
  double corner[3][3] = {{-0.5, -0.2, 0}, {0.5, -0.5, 0}, {0.6, 0.8, 0}};
  const CwPlane left = {{-1, 0, 0}, 0}, right = {{1, 0, 0}, 1}, lower = {{0, -1, 0}, 0}, upper = {{0, 1, 0}, 1};
  double a[CW_CLIP_MAX][3], b[CW_CLIP_MAX][3];
  // Left: {2,3} gives 3, {3,1} gives 3', {1,2} gives 1', 2.
  assert_int_equal(cw_clip_polygon(&left, 3, (const double(*)[3])corner, a), 4);
  // Right: nothing changes.
  assert_int_equal(cw_clip_polygon(&right, 4, (const double(*)[3])a, b), 4);
  assert_memory_equal(a, b, 4 * sizeof *a);
  // Lower: {3',1'} gives 3'', {1',2} nothing, {2,3} gives 2', 3, {3,3'} gives 3'.
  assert_int_equal(cw_clip_polygon(&lower, 4, (const double(*)[3])b, a), 4);
  assert_int_equal(cw_clip_polygon(&upper, 4, (const double(*)[3])a, b), 4);
  int first = 0;
  while (first < 4 && b[first][0] < 0.5) first++;       // 2' leads
  assert_point(b[first], 0.5 + 0.1 * 0.5 / 1.3, 0);     // 2': on edge 2-3
  assert_point(b[(first + 1) % 4], 0.6, 0.8);           // 3
  assert_point(b[(first + 2) % 4], 0, 0.8 - 0.6 / 1.1); // 3': on edge 3-1
  assert_point(b[(first + 3) % 4], 0, 0);               // 3'': on the left border, lower edge
}

static void corner_on_the_plane_is_kept_once(void **state) {
  const double corner[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const CwPlane plane = {{1, 0, 0}, 0}; // through two corners: all of the rest is outside
  double kept[CW_CLIP_MAX][3];
  assert_int_equal(cw_clip_polygon(&plane, 3, corner, kept), 0);
  const CwPlane other = cw_plane_flipped(&plane);
  assert_int_equal(cw_clip_polygon(&other, 3, corner, kept), 3);
  assert_memory_equal(kept, corner, sizeof corner);
  const CwPlane through_one = {{0.70710678118654757, -0.70710678118654757, 0}, 0}; // through corner 0, cuts edge 1-2
  assert_int_equal(cw_clip_polygon(&through_one, 3, corner, kept), 3);
}

// Both sides of a plane, and both triangles at an edge, get the same crossing to the last bit.
static void both_sides_get_the_same_bits(void **state) {
  uint64_t seed = 7;
  int cut = 0;
  for (int trial = 0; trial < 10000; trial++) {
    double corner[3][3], turned[3][3], a[CW_CLIP_MAX][3], b[CW_CLIP_MAX][3];
    CwPlane plane = {{0, 0, 0}, draw(&seed) - 0.5};
    for (int k = 0; k < 3; k++) {
      plane.normal[k] = draw(&seed) - 0.5;
      for (int c = 0; c < 3; c++) corner[c][k] = draw(&seed) - 0.5;
    }
    for (int c = 0; c < 3; c++) memcpy(turned[c], corner[(4 - c) % 3], sizeof *corner);
    CwPlane flipped = cw_plane_flipped(&plane);
    int below = cw_clip_polygon(&plane, 3, (const double(*)[3])corner, a);
    int above = cw_clip_polygon(&flipped, 3, (const double(*)[3])turned, b);
    if (!below || !above) continue;
    cut++;
    int shared = 0;
    for (int i = 0; i < below; i++) {
      for (int j = 0; j < above; j++) shared += !memcmp(a[i], b[j], sizeof *a);
    }
    assert_int_equal(shared, 2);
    assert_int_equal(below + above, 7); // a triangle cut in two: 3 + 4 corners
  }
  assert_true(cut > 1000);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(worked_example_of_the_paper),
      cmocka_unit_test(corner_on_the_plane_is_kept_once),
      cmocka_unit_test(both_sides_get_the_same_bits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
