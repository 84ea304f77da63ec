// SPDX-License-Identifier: AGPL-3.0-or-later
// What the case asks of each patch: relative size and, on walls, the first height of the layers.
#pragma once

#include "mesher/thickness/first_height.h"
#include "pipeline/case.h"
#include "pipeline/model.h"

// What a wall asks of its layers.
typedef struct {
  double first_height; // m, or in the unit of the model
  double growth;       // largest ratio of neighbouring layers
  double thickness;    // the same, of all layers together, no more than first height, count and growth give
  double last;         // greatest height of the last layer, over that of a regular tetrahedron on it
} CwLayerTarget;

// What the case asks of a patch, lengths in m.
typedef struct {
  double relative_size;
  CwWallGroup walls;   // of its group, but for a y+ of its own
  CwWallFlow flow;     // of walls
  CwFirstHeight first; // of walls
} CwPatchTarget;

// But for the first height.
CwPatchTarget cw_patch_target(const CwCase *table, const CwModelPatch *patch);

// The layers, m, that `group` asks for from a first height on, `layer_count` of them.
CwLayerTarget cw_layer_target(const CwCase *table, const CwWallGroup *group, double first_height, int layer_count);
