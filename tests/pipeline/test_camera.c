// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/camera.h"

#include <math.h>
#include <string.h>

#include "tests/draw.h"
#include "tests/unit_test.h"

static void draw_vector(uint64_t *seed, double size, double v[3]) {
  for (int k = 0; k < 3; k++) v[k] = size * (2 * draw(seed) - 1);
}

// From the front, z up: x runs to the right, and y away from who looks.
static void a_view_by_hand(void **state) {
  const double front[3] = {0, -3, 0}, up[3] = {0, 1, 5};
  CwCamera camera = {.width = 400, .height = 200, .metres_per_pixel = 0.01, .centre = {1, 0, 2}};
  double pixel[3];
  cw_camera_turn(&camera, front, up);
  cw_camera_project(&camera, (double[]){1, 0, 2}, pixel);
  assert_near(pixel[0], 200, 1e-12);
  assert_near(pixel[1], 100, 1e-12);
  assert_near(pixel[2], 0, 1e-12);
  cw_camera_project(&camera, (double[]){1.5, 0.25, 2.1}, pixel);
  assert_near(pixel[0], 250, 1e-9);
  assert_near(pixel[1], 90, 1e-9); // y down
  assert_near(pixel[2], -0.25, 1e-12);
}

// The directions are orthonormal and right-handed, towards is the one given, and up has as much of the given one as is
// square to it.
static void directions_are_orthonormal(void **state) {
  uint64_t seed = 31;
  for (int i = 0; i < 1000; i++) {
    CwCamera camera;
    double towards[3], up[3], across[3];
    draw_vector(&seed, 50, towards);
    draw_vector(&seed, 0.02, up);
    cw_camera_turn(&camera, towards, up);
    const double *axis[3] = {camera.right, camera.up, camera.towards};
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) assert_near(cw_dot(axis[a], axis[b]), a == b, 1e-12);
    cw_cross(camera.right, camera.up, across);
    assert_near(cw_dot(across, camera.towards), 1, 1e-12);
    assert_near(cw_dot(camera.towards, towards), cw_norm(towards), 1e-12 * cw_norm(towards));
    assert_near(cw_dot(camera.right, up), 0, 1e-12);
    assert_true(cw_dot(camera.up, up) > 0);
  }
}

// All points of a reach are seen with the margin round them, as large as that allows, in the middle.
static void a_fit_shows_all(void **state) {
  uint64_t seed = 32;
  for (int i = 0; i < 500; i++) {
    enum { POINTS = 30 };
    const double margin = 20 * draw(&seed), stretch = pow(10, 2 * draw(&seed) - 1);
    CwCamera camera = {.width = 300, .height = 200};
    CwCameraReach reach = {0};
    double x[POINTS][3], towards[3], up[3], least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    draw_vector(&seed, 1, towards);
    draw_vector(&seed, 1, up);
    cw_camera_turn(&camera, towards, up);
    for (int p = 0; p < POINTS; p++) {
      draw_vector(&seed, 0.3, x[p]);
      x[p][0] = 5 + stretch * x[p][0]; // far from the origin
      cw_camera_reach(&camera, x[p], &reach);
    }
    cw_camera_fit(&camera, &reach, margin);
    for (int p = 0; p < POINTS; p++) {
      double pixel[3];
      cw_camera_project(&camera, x[p], pixel);
      for (int k = 0; k < 2; k++) {
        least[k] = fmin(least[k], pixel[k]);
        most[k] = fmax(most[k], pixel[k]);
      }
    }
    const double room[2] = {least[0] - margin, least[1] - margin};
    assert_near(least[0] + most[0], 300, 1e-8);
    assert_near(least[1] + most[1], 200, 1e-8);
    assert_true(room[0] > -1e-8 && room[1] > -1e-8);
    assert_near(fmin(room[0], room[1]), 0, 1e-8);
  }
}

// One point has no extent; it still stands in the middle, at a finite scale.
static void one_point_is_seen(void **state) {
  CwCamera camera = {.width = 300, .height = 200};
  CwCameraReach reach = {0};
  const double x[3] = {1, 2, 3};
  double pixel[3];
  cw_camera_turn(&camera, (double[]){0, 0, 1}, (double[]){0, 1, 0});
  cw_camera_reach(&camera, x, &reach);
  cw_camera_fit(&camera, &reach, 10);
  assert_true(camera.metres_per_pixel > 0);
  cw_camera_project(&camera, x, pixel);
  assert_near(pixel[0], 150, 1e-9);
  assert_near(pixel[1], 100, 1e-9);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_view_by_hand),
      cmocka_unit_test(directions_are_orthonormal),
      cmocka_unit_test(a_fit_shows_all),
      cmocka_unit_test(one_point_is_seen),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
