// SPDX-License-Identifier: AGPL-3.0-or-later
// What the case asks of each patch: relative size and, on walls, the first height of the layers.
#ifndef CUTWATER_MESHER_THICKNESS_WALL_TARGETS_H
#define CUTWATER_MESHER_THICKNESS_WALL_TARGETS_H

#include "mesher/cad/cad.h"
#include "mesher/thickness/first_height.h"
#include "pipeline/case.h"

// What a wall asks of its layers.
typedef struct {
  double first_height; // m, or in the unit of the model
  double growth;       // largest ratio of neighbouring layers
  double thickness;    // the same, of all layers together, no more than first height, count and growth give
  double last;         // greatest height of the last layer, over that of a regular tetrahedron on it
} CwLayerTarget;

// The flow along the walls, from geometry/design.json.
typedef struct {
  CwWallFlow blade;         // blades, hub and shroud: the mean along the blade, in the passage between two blades
  CwWallFlow trailing_edge; // of the blades, before the interface
  CwWallFlow neck, volute, suction, diffuser, discharge;
} CwFlowScales;

// Reads them. Fails with CW_ERR_IO or CW_ERR_INPUT naming file and key.
CwStatus cw_flow_scales_read(const char *design_path, CwFlowScales *scales);

// What the case asks of a patch, lengths in m.
typedef struct {
  double relative_size;
  CwWallFlow flow;     // of walls
  CwFirstHeight first; // of walls
} CwPatchTarget;

// For each patch of the CAD, but for the first height; `target` holds cw_cad_patch_count of them.
void cw_patch_targets(const CwCad *cad, const CwCase *table, const CwFlowScales *scales, CwPatchTarget *target);

// The layers, m, that `group` asks for from a first height on, `layer_count` of them.
CwLayerTarget cw_layer_target(const CwCase *table, const CwWallGroup *group, double first_height, int layer_count);

#endif
