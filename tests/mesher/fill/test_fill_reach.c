// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>

#include "mesher/fill/fill_reach.h"
#include "tests/unit_test.h"

static const double A[3] = {0, 0, 0}, B[3] = {1, 0, 0}, C[3] = {0, 1, 0};

static void sphere_is_the_smallest_through_the_corners(void **unused) {
  CwReachBox box;
  CwReachBall ball;
  cw_reach_of_triangle(A, B, C, 10, 1, &box, &ball);
  assert_near(ball.centre[0], 0.5, 1e-12);
  assert_near(ball.centre[1], 0.5, 1e-12);
  assert_near(ball.centre[2], 0, 1e-12);
  assert_near(ball.square, 0.5, 1e-12);
  assert_near(ball.edge, sqrt(4.0 / 3.0), 1e-12);
  assert_true(cw_reach_in_ball(&ball, (double[3]){0.5, 0.5, 0.7}));
  assert_false(cw_reach_in_ball(&ball, (double[3]){0.5, 0.5, 0.71}));
  cw_reach_of_triangle(A, B, C, 10, 2, &box, &ball);
  assert_near(ball.square, 2, 1e-12);
}

static void sphere_of_a_needle_is_no_larger_than_its_edges(void **unused) {
  CwReachBox box;
  CwReachBall ball;
  const double tip[3] = {0.5, 1e-3, 0};
  cw_reach_of_triangle(A, B, tip, 10, 1, &box, &ball);
  assert_near(ball.square, 1, 1e-12);
}

// Half of h, or of the edges, from the inside of the triangle, from an edge and from a corner.
static void distance_is_half_of_the_shorter_length(void **unused) {
  static const double foot[3][3] = {{0.3, 0.3, 0}, {0.4, 0, 0}, {1, 0, 0}};
  static const double way[3][3] = {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}};
  CwReachBox box;
  CwReachBall ball;
  cw_reach_of_triangle(A, B, C, 10, 1, &box, &ball);
  for (int k = 0; k < 3; k++) {
    for (int large = 0; large < 2; large++) {
      double h = large ? 10.0 : 0.2, nearest = 0.5 * fmin(h, ball.edge), in[3], out[3];
      for (int i = 0; i < 3; i++) {
        in[i] = foot[k][i] + 0.999 * nearest * way[k][i];
        out[i] = foot[k][i] + 1.001 * nearest * way[k][i];
      }
      assert_true(cw_reach_is_near(A, B, C, &ball, h, 1, in));
      assert_false(cw_reach_is_near(A, B, C, &ball, h, 1, out));
      assert_true(cw_reach_is_near(A, B, C, &ball, h, 1.1, out));
    }
  }
}

static void box_holds_all_that_is_forbidden(void **unused) {
  CwReachBox box;
  CwReachBall ball;
  int forbidden = 0;
  cw_reach_of_triangle(A, B, C, 0.6, 1.2, &box, &ball);
  for (int k = 0; k < 40 * 40 * 40; k++) {
    double x[3] = {-1 + 0.075 * (k % 40), -1 + 0.075 * (k / 40 % 40), -1.5 + 0.075 * (k / 1600)};
    float p[3] = {(float)x[0], (float)x[1], (float)x[2]};
    if (!cw_reach_in_ball(&ball, x) && !cw_reach_is_near(A, B, C, &ball, 0.6, 1.2, x)) continue;
    assert_true(cw_reach_holds(&box, p));
    forbidden++;
  }
  assert_true(forbidden > 1000);
  box = cw_reach_box(B, 0.25);
  assert_true(cw_reach_holds(&box, (float[3]){1.25f, -0.25f, 0.25f}));
  assert_false(cw_reach_holds(&box, (float[3]){1.26f, 0, 0}));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sphere_is_the_smallest_through_the_corners),
      cmocka_unit_test(sphere_of_a_needle_is_no_larger_than_its_edges),
      cmocka_unit_test(distance_is_half_of_the_shorter_length),
      cmocka_unit_test(box_holds_all_that_is_forbidden),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
