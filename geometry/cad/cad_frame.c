// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_frame.h"

#include <math.h>
#include <string.h>

#include "pipeline/vec.h"

void cw_cad_frame_make(const CwCaseCad *cad, CwCadFrame *frame) {
  memcpy(frame->origin, cad->point, sizeof frame->origin);
  double *x = frame->axis[0], *y = frame->axis[1], *z = frame->axis[2];
  memcpy(z, cad->axis, sizeof cad->axis);
  frame->same = z[2] == 1 && cw_dot(cad->point, cad->point) == 0;
  // x: the file's own x as far as it is across the axis, or its y where the axis lies near x.
  const int from = fabs(z[0]) < 0.9 ? 0 : 1;
  for (int i = 0; i < 3; i++) x[i] = (i == from) - z[from] * z[i];
  cw_unit(x);
  cw_cross(z, x, y);
}

void cw_cad_frame_from_file(const CwCadFrame *frame, const double file[3], double pump[3]) {
  double from[3];
  cw_sub(file, frame->origin, from);
  for (int i = 0; i < 3; i++) pump[i] = cw_dot(frame->axis[i], from);
}

void cw_cad_frame_to_file(const CwCadFrame *frame, const double pump[3], double file[3]) {
  double x[3];
  for (int i = 0; i < 3; i++)
    x[i] = frame->origin[i] + frame->axis[0][i] * pump[0] + frame->axis[1][i] * pump[1] + frame->axis[2][i] * pump[2];
  memcpy(file, x, sizeof x);
}
