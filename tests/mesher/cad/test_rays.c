// SPDX-License-Identifier: AGPL-3.0-or-later

#include <math.h>

#include "mesher/cad/rays.h"
#include "octahedron.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static CwRays *rays_through(const CwBackground *background) {
  CwRays *rays = NULL;
  assert_int_equal(cw_rays_make(NULL, background->point_count, (const double(*)[3])background->x,
                                background->triangle_count, (const int32_t(*)[3])background->triangle, &rays),
                   CW_OK);
  return rays;
}

static void rays_leave_where_they_should(void **state) {
  Octahedron shape;
  CwBackground background = octahedron(&shape, 1);
  CwRays *rays = rays_through(&background);
  double s = 0;
  assert_true(fabs(cw_background_volume(&background) - 4.0 / 3 * (1 - 1.0 / 64)) < 1e-15);

  // From (0.3, 0.1, 0.1) along +x: to |x| = 0.8, through the triangle of the octant + + +.
  const double right[3] = {1, 0, 0}, left[3] = {-1, 0, 0}, start[3] = {0.3, 0.1, 0.1};
  assert_int_equal(cw_rays_exit(rays, start, right, 0, 10, &s), 0);
  assert_true(fabs(s - 0.5) < 1e-14);
  // Along -x: into the hole at x = 0.05, which is an exit; without the hole to x = -0.8.
  assert_int_equal(cw_rays_exit(rays, start, left, 0, 10, &s), 8);
  assert_true(fabs(s - 0.25) < 1e-14);
  // Past it: the ray comes out of the hole (an entry, passed over) and leaves at x = -0.8 through octant - +
  // +.
  assert_int_equal(cw_rays_exit(rays, start, left, 0.26, 10, &s), 1);
  assert_true(fabs(s - 1.1) < 1e-14);
  assert_int_equal(cw_rays_exit(rays, start, left, 0, 0.2, &s), -1);
  assert_int_equal(cw_rays_exit(rays, start, left, 2, 10, &s), -1);
  cw_rays_free(&rays);
  assert_null(rays);
}

static void a_line_meets_the_walls_in_order(void **state) {
  Octahedron shape;
  CwBackground background = octahedron(&shape, 1);
  CwRays *rays = rays_through(&background);
  CwRayHit hit[8];
  const double place[4] = {-0.8, -0.05, 0.05, 0.8}, right[3] = {1, 0, 0}, point[3] = {0, 0.1, 0.1};
  const int32_t triangle[4] = {1, 9, 8, 0};
  assert_int_equal(cw_rays_hits(rays, point, right, -2, 2, 8, hit), 4);
  for (int i = 0; i < 4; i++) {
    assert_true(fabs(hit[i].place - place[i]) < 1e-14);
    assert_int_equal(hit[i].triangle, triangle[i]);
  }
  assert_int_equal(cw_rays_hits(rays, point, right, 0, 2, 8, hit), 2);
  assert_int_equal(hit[0].triangle, 8);
  assert_int_equal(cw_rays_hits(rays, point, right, 0.06, 0.79, 8, hit), 0);
  assert_int_equal(cw_rays_hits(rays, point, right, -2, 2, 3, hit), 3);
  cw_rays_free(&rays);
}

static void many_rays_agree_with_the_formula(void **state) {
  Octahedron shape;
  CwBackground background = octahedron(&shape, 0);
  CwRays *rays = rays_through(&background);
  uint64_t seed = 7;
  for (int i = 0; i < 10000; i++) {
    double x[3], d[3], size = 0, s = 0;
    for (int k = 0; k < 3; k++) {
      x[k] = (draw(&seed) - 0.5) * 0.6;
      d[k] = draw(&seed) - 0.5;
      size += d[k] * d[k];
    }
    for (int k = 0; k < 3; k++) d[k] /= sqrt(size);
    assert_true(cw_rays_exit(rays, x, d, 0, 10, &s) >= 0);
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += fabs(x[k] + s * d[k]);
    assert_true(fabs(sum - 1) < 1e-13);
  }
  cw_rays_free(&rays);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rays_leave_where_they_should),
      cmocka_unit_test(a_line_meets_the_walls_in_order),
      cmocka_unit_test(many_rays_agree_with_the_formula),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
