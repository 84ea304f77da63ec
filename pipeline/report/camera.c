// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/camera.h"

#include <math.h>

#include "pipeline/vec.h"

void cw_camera_turn(CwCamera *camera, const double towards[3], const double up[3]) {
  cw_copy(towards, camera->towards);
  cw_unit(camera->towards);
  cw_cross(up, camera->towards, camera->right);
  cw_unit(camera->right);
  cw_cross(camera->towards, camera->right, camera->up);
}

void cw_camera_fit(CwCamera *camera, const CwCameraReach *reach, double margin) {
  double middle[2] = {0.5 * (reach->least[0] + reach->most[0]), 0.5 * (reach->least[1] + reach->most[1])};
  for (int i = 0; i < 3; i++) camera->centre[i] = middle[0] * camera->right[i] + middle[1] * camera->up[i];
  camera->metres_per_pixel = fmax((reach->most[0] - reach->least[0]) / (camera->width - 2 * margin),
                                  (reach->most[1] - reach->least[1]) / (camera->height - 2 * margin));
  if (!(camera->metres_per_pixel > 0)) camera->metres_per_pixel = 1e-3;
}
