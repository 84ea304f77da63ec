// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/saturne_case.h"

#include "export/case_values.h"
#include "export/patch_role.h"

// Selects nothing: every face has a group.
static const char none[] = "no_group[]";

static int is_inlet(const CwMesh *mesh, const CwModelPatch *patch) {
  return patch->kind == CW_PATCH_INLET;
}

static int is_outlet(const CwMesh *mesh, const CwModelPatch *patch) {
  return patch->kind == CW_PATCH_OUTLET;
}

static int is_symmetry(const CwMesh *mesh, const CwModelPatch *patch) {
  return patch->kind == CW_PATCH_SYMMETRY;
}

static int stands_in_rotor(const CwMesh *mesh, const CwModelPatch *patch) {
  return mesh->domains[patch->domain].rotating && cw_patch_stands(mesh, patch);
}

static CwStatus set_groups(const CwAssembly *a, const char *key, CwPatchChoice wanted, CwValues *values) {
  return cw_patch_count(a, -1, wanted) ? cw_patch_names_set(a, -1, wanted, " or ", key, values)
                                       : cw_values_set(values, key, "%s", none);
}

static CwStatus set_zones(const CwMesh *mesh, CwValues *values) {
  CwStatus status = CW_OK;
  int count = 0;
  CW_TRY(cw_values_start(values, "rotor_zones"));
  for (int d = 0; d < mesh->domain_count; ++d)
    if (mesh->domains[d].rotating)
      CW_TRY(cw_values_append(values, "rotor_zones", "%s%s", count++ ? " or " : "", mesh->domains[d].zone));
  if (!count) CW_TRY(cw_values_set(values, "rotor_zones", "%s", none));
done:
  return status;
}

static CwStatus set_ends(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  double area = 0;
  int count = 0;
  CW_TRY(cw_values_start(values, "outlet_shares"));
  for (int p = 0; p < mesh->patch_count; ++p)
    if (mesh->patches[p].kind == CW_PATCH_OUTLET && cw_patch_is_there(a, p))
      CW_TRY(cw_values_append(values, "outlet_shares", "%s{\"%s\", %.9g}", count++ ? ", " : "", mesh->patches[p].name,
                              mesh->patches[p].flow_share));
  CW_TRY(cw_values_start(values, "interfaces"));
  for (int i = 0; i < mesh->interface_count; ++i) {
    const int *patch = mesh->interfaces[i].patch;
    CW_TRY(cw_values_append(values, "interfaces", "%s\"%s or %s\"", i ? ", " : "", mesh->patches[patch[0]].name,
                            mesh->patches[patch[1]].name));
    area += a->patches[patch[0]].area + a->patches[patch[1]].area;
  }
  CW_TRY(cw_values_set(values, "interface_area", "%.9g", area));
done:
  return status;
}

static CwStatus set_numbers(const CwCase *table, const CwMesh *mesh, CwValues *values) {
  CwStatus status = CW_OK;
  const CwModelFlow *flow = &mesh->flow;
  const CwTurbulence inlet = cw_turbulence(flow->inlet_speed, flow->inlet_diameter);
  static const char *const models[] = {
      [CW_K_EPSILON] = "CS_TURB_K_EPSILON", [CW_SST] = "CS_TURB_K_OMEGA", [CW_LAMINAR] = "CS_TURB_NONE"};
  const CwTurbulenceModel model = cw_turbulence_model(mesh);
  CW_TRY(cw_case_values_set(table, values));
  CW_TRY(cw_values_set(values, "turbulence", "%s", models[model]));
  // The length whose law has the velocity that OpenFOAM's rough wall function has: E / Cs = 9.8 / 0.5 in it. Laminar
  // flow has none.
  CW_TRY(cw_values_set(values, "roughness_length", "%.9g",
                       model == CW_LAMINAR ? 0 : cw_wall_roughness(&table->walls) * 0.5 / 9.8));
  CW_TRY(cw_values_set(values, "passage_speed", "%.9g", flow->passage_speed));
  CW_TRY(cw_values_set(values, "passage_width", "%.9g", flow->passage_width));
  CW_TRY(cw_values_set(values, "inlet_k", "%.9g", inlet.k));
  CW_TRY(cw_values_set(values, "inlet_epsilon", "%.9g", inlet.epsilon));
done:
  return status;
}

CwStatus cw_saturne_case_write(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  CwValues values = {0};
  CW_TRY(set_numbers(table, a->mesh, &values));
  CW_TRY(set_zones(a->mesh, &values));
  CW_TRY(set_groups(a, "turning_walls", cw_patch_turns, &values));
  CW_TRY(set_groups(a, "standing_walls", stands_in_rotor, &values));
  CW_TRY(set_groups(a, "shafts", cw_patch_is_shaft, &values));
  CW_TRY(set_groups(a, "symmetries", is_symmetry, &values));
  CW_TRY(set_groups(a, "inlets", is_inlet, &values));
  CW_TRY(set_groups(a, "outlets", is_outlet, &values));
  CW_TRY(set_ends(a, &values));
  CW_TRY(cw_templates_write("code_saturne", folder, NULL, &values));
done:
  cw_values_free(&values);
  return status;
}
