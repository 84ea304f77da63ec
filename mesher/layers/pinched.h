// SPDX-License-Identifier: AGPL-3.0-or-later
// Where columns have no height, and the layers around taper to nothing: where no direction sees all faces about an edge
// or a corner of the solid, or none does that also lies in the open face beside them (cusps, corners of opposite
// planes, walls that go on smoothly as an inlet or interface); and where layers were found not to stand.
#pragma once

#include <stdint.h>

#include "mesher/cad/cad.h"
#include "pipeline/status.h"

// Zeroed: none.
typedef struct {
  double x[3], radius; // columns within the radius have no height, in the unit of the model
} CwPinchedPlace;

typedef struct {
  int32_t edges, corners;        // of the CAD, on which no column can stand, if only on a part of an edge
  uint8_t *on_edge, *on_corner;  // of each edge and corner: whether it is one
  int32_t open;                  // inlet, outlet, symmetry or interface that the first of them meets, -1: none
  double at[3];                  // a place on that
  int32_t place_count, capacity; //
  CwPinchedPlace *place;         // where layers do not stand
} CwPinched;

// Finds the edges and corners of the CAD's walls on which no column can stand. Whether faces point out of the solid
// must be settled (cw_background_join).
CwStatus cw_pinched_find(const CwCad *cad, CwPinched *pinched);
// Whether no column can stand on an edge at parameter t, off its ends.
int cw_pinched_at(const CwCad *cad, int32_t edge, double t);
CwStatus cw_pinched_add(const CwPinchedPlace *place, CwPinched *pinched);
void cw_pinched_free(CwPinched *pinched);
