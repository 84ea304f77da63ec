// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/wall_group.h"

const CwWallGroup *cw_wall_group(const CwWalls *walls, CwPatchGroup group) {
  const CwWallGroup *const groups[] = {[CW_GROUP_BLADE] = &walls->blade,
                                       [CW_GROUP_HUB_SHROUD] = &walls->hub_shroud,
                                       [CW_GROUP_VOLUTE] = &walls->volute,
                                       [CW_GROUP_PIPE] = &walls->pipe};
  return groups[group];
}

int cw_walls_auto(const CwWalls *walls) {
  for (CwPatchGroup g = CW_GROUP_BLADE; g <= CW_GROUP_PIPE; ++g) {
    const CwWallGroup *group = cw_wall_group(walls, g);
    if (!cw_case_given(group->y_plus) && !cw_case_given(group->first_height)) return 1;
  }
  return 0;
}
