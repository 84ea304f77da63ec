// SPDX-License-Identifier: AGPL-3.0-or-later
// An orthographic view: from lengths in m to pixels, y down, with the depth in m towards the viewer.
#pragma once

#include "pipeline/vec.h"

typedef struct {
  double right[3], up[3], towards[3]; // orthonormal
  double centre[3];                   // m, in the middle of the picture
  double metres_per_pixel;
  int width, height;
} CwCamera;

// Sets the three directions from one towards the viewer and one that shall point upwards, of any length, not
// parallel.
void cw_camera_turn(CwCamera *camera, const double towards[3], const double up[3]);

// A point of the view by its way from the centre, m.
static inline void cw_camera_place(const CwCamera *camera, double right, double up, double towards, double pixel[3]) {
  pixel[0] = 0.5 * camera->width + right / camera->metres_per_pixel;
  pixel[1] = 0.5 * camera->height - up / camera->metres_per_pixel;
  pixel[2] = towards;
}

static inline void cw_camera_project(const CwCamera *camera, const double x[3], double pixel[3]) {
  double from[3];
  cw_sub(x, camera->centre, from);
  cw_camera_place(camera, cw_dot(from, camera->right), cw_dot(from, camera->up), cw_dot(from, camera->towards), pixel);
}

// What a view must hold, collected point by point; start from zero.
typedef struct {
  int started;
  double least[2], most[2]; // along right and up, m
} CwCameraReach;

static inline void cw_camera_reach(const CwCamera *camera, const double x[3], CwCameraReach *reach) {
  double at[2] = {cw_dot(x, camera->right), cw_dot(x, camera->up)};
  for (int i = 0; i < 2; i++) {
    if (!reach->started || at[i] < reach->least[i]) reach->least[i] = at[i];
    if (!reach->started || at[i] > reach->most[i]) reach->most[i] = at[i];
  }
  reach->started = 1;
}

// Sets centre and scale so that all of `reach` is seen, with `margin` px around it.
void cw_camera_fit(CwCamera *camera, const CwCameraReach *reach, double margin);
