// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/wall_group.h"

#include <math.h>

const CwWallGroup *cw_wall_group(const CwWalls *walls, CwPatchGroup group) {
  const CwWallGroup *const groups[] = {[CW_GROUP_BLADE] = &walls->blade,
                                       [CW_GROUP_HUB_SHROUD] = &walls->hub_shroud,
                                       [CW_GROUP_VOLUTE] = &walls->volute,
                                       [CW_GROUP_PIPE] = &walls->pipe};
  return groups[group];
}

CwWallGroup cw_patch_walls(const CwWalls *walls, const CwModelPatch *patch) {
  CwWallGroup asked = *cw_wall_group(walls, patch->group);
  if (cw_case_given(patch->y_plus_asked)) {
    asked.y_plus = patch->y_plus_asked;
    asked.first_height = NAN;
  }
  return asked;
}

int cw_walls_auto(const CwWalls *walls) {
  for (CwPatchGroup g = CW_GROUP_BLADE; g <= CW_GROUP_PIPE; ++g) {
    const CwWallGroup *group = cw_wall_group(walls, g);
    if (!cw_case_given(group->y_plus) && !cw_case_given(group->first_height)) return 1;
  }
  return 0;
}
