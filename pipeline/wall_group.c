// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/wall_group.h"

#include <string.h>

static int starts_with(const char *text, const char *start) {
  return strncmp(text, start, strlen(start)) == 0;
}

const CwWallGroup *cw_wall_group(const CwWalls *walls, const char *patch) {
  static const char *const pipes[] = {"suction_pipe", "inlet_pipe", "diffuser", "discharge", "outlet_pipe"};
  if (starts_with(patch, "blade")) return &walls->blade;
  if (starts_with(patch, "hub") || starts_with(patch, "shroud")) return &walls->hub_shroud;
  for (size_t i = 0; i < sizeof pipes / sizeof *pipes; ++i)
    if (!strcmp(patch, pipes[i])) return &walls->pipe;
  return &walls->volute;
}

int cw_walls_auto(const CwWalls *walls) {
  const CwWallGroup *const group[] = {&walls->blade, &walls->hub_shroud, &walls->volute, &walls->pipe};
  for (size_t i = 0; i < sizeof group / sizeof *group; ++i)
    if (!cw_case_given(group[i]->y_plus) && !cw_case_given(group[i]->first_height)) return 1;
  return 0;
}
