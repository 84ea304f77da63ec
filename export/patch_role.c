// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/patch_role.h"

#include <string.h>

int cw_patch_rotates(const CwMeshPatch *patch) {
  return patch->domain == CW_MESH_ROTOR && patch->kind == CW_KIND_WALL &&
         strcmp(patch->name, "suction_pipe") != 0;
}

int cw_patch_is_shaft(const CwMeshPatch *patch) {
  return patch->domain > CW_MESH_STATOR && strcmp(patch->name, "hub_shaft_pipe") == 0;
}

double cw_patch_y_plus(const CwMeshPatch *patch, const CwWalls *walls) {
  if (strncmp(patch->name, "blade", 5) == 0)
    return walls->blade.y_plus;
  if (cw_patch_rotates(patch) || cw_patch_is_shaft(patch))
    return walls->hub_shroud.y_plus;
  if (patch->domain == CW_MESH_ROTOR || strcmp(patch->name, "discharge") == 0 ||
      strcmp(patch->name, "inlet_pipe") == 0 || strcmp(patch->name, "outlet_pipe") == 0)
    return walls->pipe.y_plus;
  return walls->volute.y_plus;
}

int cw_walls_resolved(const CwMesh *mesh, const CwWalls *walls) {
  for (int p = 0; p < mesh->patch_count; ++p)
    if (mesh->patches[p].kind == CW_KIND_WALL &&
        cw_patch_y_plus(&mesh->patches[p], walls) < CW_Y_PLUS_LAMINAR)
      return 1;
  return 0;
}
