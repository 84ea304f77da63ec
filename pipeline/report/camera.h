// SPDX-License-Identifier: AGPL-3.0-or-later
// An orthographic view: from lengths in m to pixels, y down, with the depth in m towards the viewer.
#ifndef CUTWATER_PIPELINE_REPORT_CAMERA_H
#define CUTWATER_PIPELINE_REPORT_CAMERA_H

typedef struct {
  double right[3], up[3], towards[3]; // orthonormal
  double centre[3];                   // m, in the middle of the picture
  double metres_per_pixel;
  int width, height;
} CwCamera;

// Sets the three directions from one towards the viewer and one that shall point upwards, of any length, not
// parallel.
void cw_camera_turn(CwCamera *camera, const double towards[3], const double up[3]);
void cw_camera_project(const CwCamera *camera, const double x[3], double pixel[3]);

// What a view must hold, collected point by point; start from zero.
typedef struct {
  int started;
  double least[2], most[2]; // along right and up, m
} CwCameraReach;

void cw_camera_reach(const CwCamera *camera, const double x[3], CwCameraReach *reach);
// Sets centre and scale so that all of `reach` is seen, with `margin` px around it.
void cw_camera_fit(CwCamera *camera, const CwCameraReach *reach, double margin);

#endif
