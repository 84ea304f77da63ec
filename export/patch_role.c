// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/patch_role.h"

#include <math.h>

int cw_patch_turns(const CwMesh *mesh, const CwModelPatch *patch) {
  return patch->kind == CW_PATCH_WALL && patch->turns;
}

int cw_patch_stands(const CwMesh *mesh, const CwModelPatch *patch) {
  return patch->kind == CW_PATCH_WALL && !patch->turns;
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

CwTurbulenceModel cw_turbulence_model(const CwMesh *mesh) {
  int resolved = 0, laminar = 1;
  for (int p = 0; p < mesh->patch_count; ++p) {
    const CwModelPatch *patch = &mesh->patches[p];
    resolved |= cw_patch_resolved(patch);
    laminar &= patch->kind != CW_PATCH_WALL || isnan(patch->y_plus);
  }
  return !resolved ? CW_K_EPSILON : laminar ? CW_LAMINAR : CW_SST;
}

const char *cw_turbulence_model_name(CwTurbulenceModel model) {
  static const char *const names[] = {[CW_K_EPSILON] = "k-epsilon", [CW_SST] = "k-omega SST", [CW_LAMINAR] = "laminar"};
  return names[model];
}

int cw_patch_is_there(const CwAssembly *assembly, int patch) {
  return cw_face_count(assembly->patches[patch].faces) > 0;
}

int cw_patch_kind_count(const CwMesh *mesh, CwPatchKind kind) {
  int count = 0;
  for (int p = 0; p < mesh->patch_count; ++p) count += mesh->patches[p].kind == kind;
  return count;
}

static int is_chosen(const CwAssembly *assembly, int p, int domain, CwPatchChoice wanted) {
  const CwModelPatch *patch = &assembly->mesh->patches[p];
  return cw_patch_is_there(assembly, p) && (domain < 0 || patch->domain == domain) &&
         (!wanted || wanted(assembly->mesh, patch));
}

int cw_patch_count(const CwAssembly *assembly, int domain, CwPatchChoice wanted) {
  int count = 0;
  for (int p = 0; p < assembly->mesh->patch_count; ++p) count += is_chosen(assembly, p, domain, wanted);
  return count;
}

CwStatus cw_patch_names_set(const CwAssembly *assembly, int domain, CwPatchChoice wanted, const char *between,
                            const char *key, CwValues *values) {
  CwStatus status = CW_OK;
  int count = 0;
  CW_TRY(cw_values_start(values, key));
  for (int p = 0; p < assembly->mesh->patch_count; ++p)
    if (is_chosen(assembly, p, domain, wanted))
      CW_TRY(cw_values_append(values, key, "%s%s", count++ ? between : "", assembly->mesh->patches[p].name));
done:
  return status;
}
