// SPDX-License-Identifier: AGPL-3.0-or-later
// What the case asks of each patch: relative size and, on walls, the first height of the layers.
#ifndef CUTWATER_MESHER_HEIGHTS_WALL_TARGETS_H
#define CUTWATER_MESHER_HEIGHTS_WALL_TARGETS_H

#include "mesher/cad/cad.h"
#include "pipeline/case.h"

// What a wall asks of its layers.
typedef struct {
  double first_height; // m
  double growth;       // largest ratio of neighbouring layers
  double thickness;    // m, of all layers together, no more than first height, count and growth give
} CwLayerTarget;

// Velocity and length scales of the flow along the walls, from geometry/design.json.
typedef struct {
  double relative_speed;  // m/s, mean along the blade
  double volute_speed;    // m/s
  double suction_speed;   // m/s
  double diffuser_speed;  // m/s, mean along it
  double discharge_speed; // m/s
  double blade_length;    // m, scale for blade, hub and shroud
  double volute_length;   // m
  double pipe_length;     // m
} CwFlowScales;

// Reads the scales. Fails with CW_ERR_IO or CW_ERR_INPUT naming file and key.
CwStatus cw_flow_scales_read(const char *design_path, CwFlowScales *scales);

// For each patch of the CAD: relative size, and its layers in the unit of the model (0 on caps). Both arrays hold
// cw_cad_patch_count values.
void cw_wall_targets(const CwCad *cad, const CwCase *table, const CwFlowScales *scales, double *relative_size,
                     CwLayerTarget *layers);
// The layers, m, that `group` asks for where the flow has the speed `speed` (m/s) over the length `length` (m).
CwLayerTarget cw_layer_target(const CwCase *table, const CwWallGroup *group, double speed, double length);

#endif
