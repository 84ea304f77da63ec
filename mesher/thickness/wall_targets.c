// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/wall_targets.h"

#include <math.h>

#include "mesher/policy.h"
#include "mesher/thickness/layer_count.h"
#include "mesher/thickness/layer_thickness.h"
#include "pipeline/wall_group.h"

CwLayerTarget cw_layer_target(const CwCase *table, const CwWallGroup *group, double first_height, int layer_count) {
  const CwWalls *walls = &table->walls;
  double growth = cw_case_given(group->growth_ratio) ? group->growth_ratio : walls->growth_ratio;
  CwLayerTarget target = {.first_height = first_height, .growth = growth, .last = CW_LAST_LAYER_GIVEN};
  if (!cw_case_given(growth)) {
    target.growth = 1 + cw_policy.slope;
    target.last = CW_LAST_LAYER;
  }
  // More than this would raise the first height.
  target.thickness = cw_layer_thickness(target.first_height, layer_count, target.growth);
  double asked = cw_thickness_given(walls, group);
  if (cw_case_given(asked)) target.thickness = fmin(target.thickness, asked);
  return target;
}

CwPatchTarget cw_patch_target(const CwCase *table, const CwModelPatch *patch) {
  const CwMeshTable *mesh = &table->mesh;
  const double size[] = {[CW_GROUP_BLADE] = mesh->size_blade,
                         [CW_GROUP_HUB_SHROUD] = mesh->size_hub_shroud,
                         [CW_GROUP_VOLUTE] = mesh->size_volute,
                         [CW_GROUP_PIPE] = mesh->size_pipe,
                         [CW_GROUP_INTERFACE] = mesh->size_interface};
  CwPatchTarget target = {.relative_size = size[patch->size], .flow = patch->flow};
  target.walls = cw_patch_walls(&table->walls, patch);
  return target;
}
