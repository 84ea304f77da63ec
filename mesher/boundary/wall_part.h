// SPDX-License-Identifier: AGPL-3.0-or-later
// A part of a wall as a wall of its own, for the layers.
#pragma once

#include "mesher/layers/layers.h"

typedef struct {
  const CwLayerInput *whole;
  CwLayerInput in;
  int32_t *global, *local; // of each point of the part; of the whole, -1: not in it
  double (*x)[3], *target, *least, (*constraint_normal)[2][3];
  int32_t (*triangle)[3], *constraint_count;
  uint8_t *constraint_stays, *pinched;
} CwWallPart;

// The triangles with a corner that is marked in `near`, in their order; obstacles are the whole's. `whole`, with its
// arrays, must outlive the part, and the part stays where it is.
CwStatus cw_wall_part_make(const CwLayerInput *whole, const uint8_t *near, CwWallPart *part);
void cw_wall_part_free(CwWallPart *part);
