// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/camera.h"

#include <math.h>

static double along(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3]) {
  for (int i = 0; i < 3; i++) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void unit(double a[3]) {
  double length = sqrt(along(a, a));
  for (int i = 0; i < 3; i++) a[i] /= length;
}

void cw_camera_turn(CwCamera *camera, const double towards[3], const double up[3]) {
  for (int i = 0; i < 3; i++) camera->towards[i] = towards[i];
  unit(camera->towards);
  cross(up, camera->towards, camera->right);
  unit(camera->right);
  cross(camera->towards, camera->right, camera->up);
}

void cw_camera_project(const CwCamera *camera, const double x[3], double pixel[3]) {
  double from[3] = {x[0] - camera->centre[0], x[1] - camera->centre[1], x[2] - camera->centre[2]};
  pixel[0] = 0.5 * camera->width + along(from, camera->right) / camera->metres_per_pixel;
  pixel[1] = 0.5 * camera->height - along(from, camera->up) / camera->metres_per_pixel;
  pixel[2] = along(from, camera->towards);
}

void cw_camera_reach(const CwCamera *camera, const double x[3], CwCameraReach *reach) {
  double at[2] = {along(x, camera->right), along(x, camera->up)};
  for (int i = 0; i < 2; i++) {
    reach->least[i] = reach->started ? fmin(reach->least[i], at[i]) : at[i];
    reach->most[i] = reach->started ? fmax(reach->most[i], at[i]) : at[i];
  }
  reach->started = 1;
}

void cw_camera_fit(CwCamera *camera, const CwCameraReach *reach, double margin) {
  double middle[2] = {0.5 * (reach->least[0] + reach->most[0]), 0.5 * (reach->least[1] + reach->most[1])};
  for (int i = 0; i < 3; i++) camera->centre[i] = middle[0] * camera->right[i] + middle[1] * camera->up[i];
  camera->metres_per_pixel = fmax((reach->most[0] - reach->least[0]) / (camera->width - 2 * margin),
                                  (reach->most[1] - reach->least[1]) / (camera->height - 2 * margin));
  if (!(camera->metres_per_pixel > 0)) camera->metres_per_pixel = 1e-3;
}
