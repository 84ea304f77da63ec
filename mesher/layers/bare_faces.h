// SPDX-License-Identifier: AGPL-3.0-or-later
// Walls that cannot carry layers: where no direction sees all faces about an edge or a corner of the solid, or none
// does that also lies in the open face beside them. Such are cusps, corners of opposite planes, and walls that go on
// smoothly as an inlet or interface.
#pragma once

#include <stdint.h>

#include "mesher/cad/cad.h"

// Zeroed: none.
typedef struct {
  int32_t count; // faces left bare
  int32_t first; // one of them
  int32_t open;  // the inlet, outlet, symmetry or interface that it meets at this place, -1: none
  int asked;     // 1: it was asked to be
  double at[3];  // that place, in the unit of the model
  double area;   // of all of them
  double share;  // of the area of the walls
} CwBareFaces;

// Leaves walls of the CAD bare until columns can stand on all others: at each place without a direction the face of
// the least area that frees one, or if none does, the face of the least area. Beside a bare face columns lie in it.
// `asked`: a wall that is to be bare before, since no layers stand `at` a place of it; -1: none. `area`: of each face,
// > 0. `bare` has those of before, and gets these. Whether faces point out of the solid must be settled
// (cw_background_join).
CwStatus cw_bare_faces_find(CwCad *cad, const double *area, int32_t asked, const double at[3], CwBareFaces *bare);
