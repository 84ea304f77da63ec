// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/wall_name.h"

#include <string.h>

const CwWallName *cw_wall_name(const char *name) {
  // The suction pipe stands still in the rotor; a shaft turns in a pipe of its own.
  static const CwWallName names[] = {
      {"blade", CW_ALONG_BLADE, CW_GROUP_BLADE, CW_GROUP_BLADE, -1, 0},
      {"blade_pressure", CW_ALONG_BLADE, CW_GROUP_BLADE, CW_GROUP_BLADE, -1, 0},
      {"blade_suction", CW_ALONG_BLADE, CW_GROUP_BLADE, CW_GROUP_BLADE, -1, 0},
      {"blade_leading_edge", CW_ALONG_BLADE, CW_GROUP_BLADE, CW_GROUP_BLADE, -1, 0},
      {"blade_trailing_edge", CW_ALONG_TRAILING_EDGE, CW_GROUP_BLADE, CW_GROUP_BLADE, -1, 0},
      {"hub", CW_ALONG_BLADE, CW_GROUP_HUB_SHROUD, CW_GROUP_HUB_SHROUD, -1, 0},
      {"hub_nut", CW_ALONG_BLADE, CW_GROUP_HUB_SHROUD, CW_GROUP_HUB_SHROUD, -1, 0},
      {"hub_shaft", CW_ALONG_BLADE, CW_GROUP_HUB_SHROUD, CW_GROUP_HUB_SHROUD, -1, 0},
      {"shroud", CW_ALONG_BLADE, CW_GROUP_HUB_SHROUD, CW_GROUP_HUB_SHROUD, -1, 0},
      {"hub_shaft_pipe", CW_ALONG_BLADE, CW_GROUP_HUB_SHROUD, CW_GROUP_HUB_SHROUD, 1, 0},
      {"neck", CW_ALONG_NECK, CW_GROUP_VOLUTE, CW_GROUP_INTERFACE, -1, 0},
      {"step", CW_ALONG_NECK, CW_GROUP_VOLUTE, CW_GROUP_INTERFACE, -1, 0},
      {"volute", CW_ALONG_VOLUTE, CW_GROUP_VOLUTE, CW_GROUP_VOLUTE, -1, 0},
      {"tongue", CW_ALONG_VOLUTE, CW_GROUP_VOLUTE, CW_GROUP_VOLUTE, -1, 1},
      {"suction_pipe", CW_ALONG_SUCTION, CW_GROUP_PIPE, CW_GROUP_PIPE, 0, 0},
      {"inlet_pipe", CW_ALONG_SUCTION, CW_GROUP_PIPE, CW_GROUP_PIPE, -1, 0},
      {"diffuser", CW_ALONG_DIFFUSER, CW_GROUP_PIPE, CW_GROUP_PIPE, -1, 0},
      {"discharge", CW_ALONG_DISCHARGE, CW_GROUP_PIPE, CW_GROUP_PIPE, -1, 0},
      {"outlet_pipe", CW_ALONG_DISCHARGE, CW_GROUP_PIPE, CW_GROUP_PIPE, -1, 0},
  };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (!strcmp(name, names[i].name)) return &names[i];
  return NULL;
}
