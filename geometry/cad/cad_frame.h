// SPDX-License-Identifier: AGPL-3.0-or-later
// Between the coordinates of CAD files and those of the pump, whose axis is +z through the origin.
#pragma once

#include "pipeline/case_cad.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double origin[3];  // m, in the file
  double axis[3][3]; // unit vectors x, y, z of the pump, in the file
  int same;          // 1: the file has them so already
} CwCadFrame;

void cw_cad_frame_make(const CwCaseCad *cad, CwCadFrame *frame);
// The pump's coordinates of a point of the file, and the other way; the two may be one array.
void cw_cad_frame_from_file(const CwCadFrame *frame, const double file[3], double pump[3]);
void cw_cad_frame_to_file(const CwCadFrame *frame, const double pump[3], double file[3]);

#ifdef __cplusplus
}
#endif
