// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_zones.h"

#include <stdlib.h>

#include "export/blocks.h"

// Patches of a zone that rotates and do not turn with it.
static CwStatus set_fixed_patches(const CwAssembly *a, int domain, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  CwBlocks names = {0};
  CW_TRY(cw_blocks_open(&names));
  for (int p = 0, first = 1; p < mesh->patch_count; ++p) {
    const CwModelPatch *patch = &mesh->patches[p];
    if (patch->domain != domain || !cw_patch_is_there(a, p) || cw_patch_rotates(mesh, patch)) continue;
    fprintf(names.out, "%s%s", first ? "" : " ", patch->name);
    first = 0;
  }
  CW_TRY(cw_blocks_close(&names, "fixed_patches", values));
done:
  cw_blocks_close(&names, NULL, values);
  return status;
}

static CwStatus set_motion(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  CwBlocks mrf = {0}, motion = {0}, names = {0};
  int count = 0;
  for (int d = 0; d < mesh->domain_count; ++d) count += mesh->domains[d].rotating != 0;
  CW_TRY(cw_blocks_open(&mrf));
  CW_TRY(cw_blocks_open(&motion));
  CW_TRY(cw_blocks_open(&names));
  if (count == 0)
    fprintf(motion.out, "dynamicFvMesh   staticFvMesh;\n");
  else
    fprintf(motion.out, "dynamicFvMesh   dynamicMotionSolverFvMesh;\nmotionSolverLibs (fvMotionSolvers);\n");
  if (count > 1)
    fprintf(motion.out, "motionSolver    multiSolidBodyMotionSolver;\nmultiSolidBodyMotionSolverCoeffs\n{\n");
  for (int d = 0, first = 1; d < mesh->domain_count; ++d) {
    if (!mesh->domains[d].rotating) continue;
    CW_TRY(cw_values_set(values, "zone", "%s", mesh->domains[d].name));
    CW_TRY(set_fixed_patches(a, d, values));
    CW_TRY(cw_blocks_add(&mrf, "openfoam_parts/mrf_zone", values));
    CW_TRY(cw_blocks_add(&motion, count > 1 ? "openfoam_parts/several_turn" : "openfoam_parts/one_turns", values));
    fprintf(names.out, "%s`%s`", first ? "" : ", ", mesh->domains[d].name);
    first = 0;
  }
  if (count > 1) fprintf(motion.out, "}\n");
  CW_TRY(cw_blocks_close(&mrf, "mrf_zones", values));
  CW_TRY(cw_blocks_close(&motion, "mesh_motion", values));
  CW_TRY(cw_blocks_close(&names, "rotating_zones", values));
done:
  cw_blocks_close(&mrf, NULL, values);
  cw_blocks_close(&motion, NULL, values);
  cw_blocks_close(&names, NULL, values);
  return status;
}

const char *cw_foam_end_zone(CwPatchKind kind) {
  return kind == CW_PATCH_INLET ? "inlets" : "outlets";
}

static int count_kind(const CwMesh *mesh, CwPatchKind kind) {
  int count = 0;
  for (int p = 0; p < mesh->patch_count; ++p) count += mesh->patches[p].kind == kind;
  return count;
}

static const char *first_of(const CwMesh *mesh, CwPatchKind kind) {
  for (int p = 0; p < mesh->patch_count; ++p)
    if (mesh->patches[p].kind == kind) return mesh->patches[p].name;
  return "";
}

// Where what is reported of inlets or outlets is taken: a patch, or the zone of faces of several.
static CwStatus set_ends(const CwMesh *mesh, CwPatchKind kind, CwValues *values) {
  CwStatus status = CW_OK;
  const int several = count_kind(mesh, kind) > 1;
  const char *name = several ? cw_foam_end_zone(kind) : first_of(mesh, kind), *type = several ? "faceZone" : "patch";
  const char *end = cw_patch_kind_name(kind);
  char key[40];
  snprintf(key, sizeof key, "%s_region", end);
  CW_TRY(cw_values_set(values, key, "        regionType      %s;\n        name            %s;\n", type, name));
  // The others take their lines over from the flow of the inlets.
  const int inherits = kind != CW_PATCH_INLET && several == (count_kind(mesh, CW_PATCH_INLET) > 1);
  snprintf(key, sizeof key, "%s_flow", end);
  if (inherits)
    CW_TRY(cw_values_set(values, key, "    name            %s;\n", name));
  else
    CW_TRY(cw_values_set(values, key, "    regionType      %s;\n    name            %s;\n", type, name));
done:
  return status;
}

static int rotates(const CwMesh *mesh, int interface, int side) {
  return mesh->domains[mesh->patches[mesh->interfaces[interface].patch[side]].domain].rotating;
}

static void put_flow(FILE *out, const char *function, const char *patch, int based) {
  fprintf(out, "%s\n{\n    $flowInlet;\n", function);
  if (!based) fprintf(out, "    regionType      patch;\n");
  fprintf(out, "    name            %s;\n}\n", patch);
}

static CwStatus set_interfaces(const CwMesh *mesh, int based, CwValues *values) {
  CwStatus status = CW_OK;
  CwBlocks flows = {0};
  int main = 0, turned;
  while (main < mesh->interface_count && rotates(mesh, main, 0) == rotates(mesh, main, 1)) ++main;
  turned = main < mesh->interface_count && !rotates(mesh, main, 0);
  CW_TRY(cw_blocks_open(&flows));
  for (int side = 0; side < 2; ++side) {
    const char *name =
        main < mesh->interface_count ? mesh->patches[mesh->interfaces[main].patch[side ^ turned]].name : "none";
    CW_TRY(cw_values_set(values, side ? "stator_interface" : "rotor_interface", "%s", name));
    if (main < mesh->interface_count)
      put_flow(flows.out, side ? "flowStatorInterface" : "flowRotorInterface", name, based);
  }
  for (int i = 0; i < mesh->interface_count; ++i)
    for (int side = 0; side < 2 && i != main; ++side) {
      char function[CW_MESH_NAME_SIZE + 8];
      const char *name = mesh->patches[mesh->interfaces[i].patch[side]].name;
      snprintf(function, sizeof function, "flow_%s", name);
      put_flow(flows.out, function, name, based);
    }
  CW_TRY(cw_blocks_close(&flows, "interface_flows", values));
done:
  cw_blocks_close(&flows, NULL, values);
  return status;
}

CwStatus cw_foam_zones_set(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const int based = count_kind(a->mesh, CW_PATCH_INLET) == 1;
  CW_TRY(set_motion(a, values));
  CW_TRY(set_ends(a->mesh, CW_PATCH_INLET, values));
  CW_TRY(set_ends(a->mesh, CW_PATCH_OUTLET, values));
  CW_TRY(set_interfaces(a->mesh, based, values));
  CW_TRY(cw_values_set(values, "outlet", "%s", first_of(a->mesh, CW_PATCH_OUTLET)));
done:
  return status;
}
