// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_zones.h"

#include <limits.h>
#include <stdio.h>

// A patch that does not turn with a zone that rotates.
static int is_fixed(const CwMesh *mesh, const CwModelPatch *patch) {
  return !cw_patch_rotates(mesh, patch);
}

static CwStatus set_motion(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  int count = 0;
  CW_TRY(cw_values_start(values, "mrf_zones"));
  CW_TRY(cw_values_start(values, "motion_zones"));
  CW_TRY(cw_values_start(values, "rotating_zones"));
  for (int d = 0; d < mesh->domain_count; ++d) {
    if (!mesh->domains[d].rotating) continue;
    CW_TRY(cw_values_set(values, "zone", "%s", mesh->domains[d].name));
    CW_TRY(cw_patch_names_set(a, d, is_fixed, " ", "fixed_patches", values));
    CW_TRY(cw_values_append_file(values, "mrf_zones", "openfoam_parts/mrf_zone"));
    CW_TRY(cw_values_append_file(values, "motion_zones", "openfoam_parts/motion_zone"));
    CW_TRY(cw_values_append(values, "rotating_zones", "%s`%s`", count++ ? ", " : "", mesh->domains[d].name));
  }
  CW_TRY(cw_values_set_file(values, "mesh_motion",
                            count > 1   ? "openfoam_parts/motion_several"
                            : count > 0 ? "openfoam_parts/motion_one" // of the zone that was set last
                                        : "openfoam_parts/motion_none"));
done:
  return status;
}

const char *cw_foam_end_zone(CwPatchKind kind) {
  return kind == CW_PATCH_INLET ? "inlets" : "outlets";
}

static const char *first_of(const CwMesh *mesh, CwPatchKind kind) {
  for (int p = 0; p < mesh->patch_count; ++p)
    if (mesh->patches[p].kind == kind) return mesh->patches[p].name;
  return "";
}

// Where what is reported of inlets or outlets is taken: a patch, or the zone of faces of several.
static CwStatus set_ends(const CwMesh *mesh, CwPatchKind kind, CwValues *values) {
  CwStatus status = CW_OK;
  const int several = cw_patch_kind_count(mesh, kind) > 1;
  const char *name = several ? cw_foam_end_zone(kind) : first_of(mesh, kind), *type = several ? "faceZone" : "patch";
  const char *end = cw_patch_kind_name(kind);
  char key[40];
  snprintf(key, sizeof key, "%s_region", end);
  CW_TRY(cw_values_set(values, key, "        regionType      %s;\n        name            %s;\n", type, name));
  // The others take their lines over from the flow of the inlets.
  const int inherits = kind != CW_PATCH_INLET && several == (cw_patch_kind_count(mesh, CW_PATCH_INLET) > 1);
  snprintf(key, sizeof key, "%s_flow", end);
  if (inherits)
    CW_TRY(cw_values_set(values, key, "    name            %s;\n", name));
  else
    CW_TRY(cw_values_set(values, key, "    regionType      %s;\n    name            %s;\n", type, name));
done:
  return status;
}

static int domain_at(const CwMesh *mesh, int interface, int side) {
  return mesh->patches[mesh->interfaces[interface].patch[side]].domain;
}

static int rotates(const CwMesh *mesh, int interface, int side) {
  return mesh->domains[domain_at(mesh, interface, side)].rotating != 0;
}

// For each domain how many interfaces between domains at rest lie on the way to an outlet; CW_DOMAINS_MOST where none
// leads there.
static void count_to_outlet(const CwMesh *mesh, int count[CW_DOMAINS_MOST]) {
  for (int d = 0; d < mesh->domain_count; ++d) count[d] = CW_DOMAINS_MOST;
  for (int p = 0; p < mesh->patch_count; ++p)
    if (mesh->patches[p].kind == CW_PATCH_OUTLET) count[mesh->patches[p].domain] = 0;
  for (int pass = 0; pass < mesh->domain_count; ++pass)
    for (int i = 0; i < mesh->interface_count; ++i)
      for (int side = 0; side < 2 && !rotates(mesh, i, 0) && !rotates(mesh, i, 1); ++side) {
        const int here = domain_at(mesh, i, side), there = domain_at(mesh, i, 1 - side);
        if (count[here] > count[there] + 1) count[here] = count[there] + 1;
      }
}

// The interface through which the flow leaves the rotor: of those where one side rotates the one that is nearest to an
// outlet. Without any: their number.
static int find_main(const CwMesh *mesh) {
  int count[CW_DOMAINS_MOST], main = mesh->interface_count, least = INT_MAX;
  count_to_outlet(mesh, count);
  for (int i = 0; i < mesh->interface_count; ++i) {
    if (rotates(mesh, i, 0) == rotates(mesh, i, 1)) continue;
    const int from = count[domain_at(mesh, i, rotates(mesh, i, 0))]; // the side at rest
    if (from < least) main = i, least = from;
  }
  return main;
}

static CwStatus add_flow(const char *function, const char *patch, int based, CwValues *values) {
  return cw_values_append(values, "interface_flows", "%s\n{\n    $flowInlet;\n%s    name            %s;\n}\n", function,
                          based ? "" : "    regionType      patch;\n", patch);
}

static CwStatus set_interfaces(const CwMesh *mesh, int based, CwValues *values) {
  CwStatus status = CW_OK;
  const int main = find_main(mesh), turned = main < mesh->interface_count && !rotates(mesh, main, 0);
  CW_TRY(cw_values_start(values, "interface_flows"));
  for (int side = 0; side < 2; ++side) {
    const char *name =
        main < mesh->interface_count ? mesh->patches[mesh->interfaces[main].patch[side ^ turned]].name : "none";
    CW_TRY(cw_values_set(values, side ? "stator_interface" : "rotor_interface", "%s", name));
    if (main < mesh->interface_count)
      CW_TRY(add_flow(side ? "flowStatorInterface" : "flowRotorInterface", name, based, values));
  }
  for (int i = 0; i < mesh->interface_count; ++i)
    for (int side = 0; side < 2 && i != main; ++side) {
      char function[CW_MESH_NAME_SIZE + 8];
      const char *name = mesh->patches[mesh->interfaces[i].patch[side]].name;
      snprintf(function, sizeof function, "flow_%s", name);
      CW_TRY(add_flow(function, name, based, values));
    }
done:
  return status;
}

CwStatus cw_foam_zones_set(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const int based = cw_patch_kind_count(a->mesh, CW_PATCH_INLET) == 1;
  CW_TRY(set_motion(a, values));
  CW_TRY(set_ends(a->mesh, CW_PATCH_INLET, values));
  CW_TRY(set_ends(a->mesh, CW_PATCH_OUTLET, values));
  CW_TRY(set_interfaces(a->mesh, based, values));
  CW_TRY(cw_values_set(values, "outlet", "%s", first_of(a->mesh, CW_PATCH_OUTLET)));
done:
  return status;
}
