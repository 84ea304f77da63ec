// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/common/quality.h"
#include "mesher/fill/tet_bound.h"
#include "tests/unit_test.h"

static double bound_of(int32_t points, const double (*x)[3], int32_t triangles, const int32_t (*triangle)[3],
                       int32_t *worst) {
  CwFillInput input = {
      .point_count = points, .x = x, .triangle_count = triangles, .triangle = triangle, .name = "rotor region 3"};
  double degrees;
  assert_int_equal(cw_tet_bound(&input, &degrees, worst), CW_OK);
  return degrees;
}

static const int32_t four[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

// Seen from within, half of its angles is worse than the tetrahedron itself.
static void a_tetrahedron_allows_its_own_angle(void **state) {
  const double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0.4, 0.9, 0}, {0.4, 0.35, 0.2}};
  const double *corner[4] = {x[0], x[1], x[2], x[3]};
  CwTetShape shape;
  int32_t worst;
  cw_tet_shape(corner, &shape);
  assert_true(shape.dihedral_least < CW_TET_BOUND_MOST);
  assert_near(bound_of(4, x, 4, four, &worst), shape.dihedral_least, 1e-9);
}

// A roof over a long edge, wedge angle A: the two triangles at the edge have other neighbours, and their tetrahedron is
// worse than two with A/2; or it is the better one.
static double roof(double degrees, double apart, int32_t *worst) {
  const double a = degrees * 3.14159265358979323846 / 180.0;
  // The edge 0-1; 2 and 3 on the floor and the slope, at `apart` to both sides of the middle; 4 and 5 close the far
  // side.
  const double x[6][3] = {{0, 0, 0},         {0, 2, 0},
                          {1, 1 - apart, 0}, {cos(a), 1 + apart, sin(a)},
                          {1, 1 + apart, 0}, {cos(a), 1 - apart, sin(a)}};
  // Floor 0-2-4-1, slope 0-5-3-1 and the ends 0-5-2, 1-4-3; the far side 2-5-3-4.
  const int32_t triangle[8][3] = {{0, 4, 2}, {0, 1, 4}, {0, 5, 3}, {0, 3, 1},
                                  {0, 2, 5}, {1, 3, 4}, {2, 4, 3}, {2, 3, 5}};
  return bound_of(6, x, 8, triangle, worst);
}

static void sharp_edges_allow_half_or_their_tetrahedron(void **state) {
  int32_t worst;
  for (double degrees = 4.0; degrees < 60.0; degrees += 7.0) {
    double bound = roof(degrees, 0.6, &worst);
    assert_true(worst >= 0 && bound >= 0.5 * degrees - 1e-9 && bound <= degrees + 1e-9);
  }
  // 2 and 3 face one another over the edge's middle: triangles 0-1-4 and 0-3-1 have the tetrahedron 0-1-4-3.
  assert_near(roof(10.0, 0.0001, &worst), 10.0, 0.1);
}

static void a_cube_is_not_bounded(void **state) {
  double x[8][3];
  int32_t worst;
  for (int k = 0; k < 8; k++) x[k][0] = k & 1, x[k][1] = k >> 1 & 1, x[k][2] = k >> 2;
  const int32_t triangle[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  assert_near(bound_of(8, (const double(*)[3])x, 12, triangle, &worst), CW_TET_BOUND_MOST, 0.0);
  // Turned inside out its edges are 270 degrees wide.
  int32_t turned[12][3];
  for (int t = 0; t < 12; t++)
    turned[t][0] = triangle[t][0], turned[t][1] = triangle[t][2], turned[t][2] = triangle[t][1];
  assert_near(bound_of(8, (const double(*)[3])x, 12, (const int32_t(*)[3])turned, &worst), CW_TET_BOUND_MOST, 0.0);
  assert_int_equal(worst, -1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_tetrahedron_allows_its_own_angle),
      cmocka_unit_test(sharp_edges_allow_half_or_their_tetrahedron),
      cmocka_unit_test(a_cube_is_not_bounded),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
