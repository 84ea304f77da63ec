// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/patch_role.h"

#include <stdio.h>
#include <stdlib.h>

int cw_patch_turns(const CwMesh *mesh, const CwModelPatch *patch) {
  return patch->kind == CW_PATCH_WALL && patch->turns;
}

int cw_patch_rotates(const CwMesh *mesh, const CwModelPatch *patch) {
  return cw_patch_turns(mesh, patch) && mesh->domains[patch->domain].rotating;
}

int cw_patch_is_shaft(const CwMesh *mesh, const CwModelPatch *patch) {
  return cw_patch_turns(mesh, patch) && !mesh->domains[patch->domain].rotating;
}

int cw_patch_resolved(const CwModelPatch *patch) {
  return patch->kind == CW_PATCH_WALL && !(patch->y_plus >= CW_Y_PLUS_LAMINAR);
}

int cw_walls_resolved(const CwMesh *mesh) {
  for (int p = 0; p < mesh->patch_count; ++p)
    if (cw_patch_resolved(&mesh->patches[p])) return 1;
  return 0;
}

int cw_patch_is_there(const CwAssembly *assembly, int patch) {
  return assembly->patches[patch].triangles + assembly->patches[patch].quads > 0;
}

CwStatus cw_patch_names_set(const CwAssembly *assembly, CwPatchChoice wanted, const char *between, const char *key,
                            CwValues *values) {
  CwStatus status = CW_OK;
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  CW_REQUIRE(out, CW_ERR_MEMORY, "out of memory");
  for (int p = 0, first = 1; p < assembly->mesh->patch_count; ++p)
    if (cw_patch_is_there(assembly, p) && wanted(assembly->mesh, &assembly->mesh->patches[p])) {
      fprintf(out, "%s%s", first ? "" : between, assembly->mesh->patches[p].name);
      first = 0;
    }
  fclose(out);
  CW_TRY(cw_values_set(values, key, "%s", text));
done:
  free(text);
  return status;
}
