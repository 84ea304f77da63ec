// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/fluent_case.h"

#include "export/case_values.h"
#include "export/patch_role.h"

static CwStatus add_patch(const CwCase *table, const CwMesh *mesh, const CwModelPatch *patch, CwValues *values) {
  const CwOperatingPoint *point = &table->operating_point;
  const char *name = patch->name;
  switch (patch->kind) {
  case CW_PATCH_INLET:
    return cw_values_append(values, "zones", "| %s | pressure-inlet | total pressure %.9g Pa, absolute frame |\n", name,
                            point->inlet_pressure);
  case CW_PATCH_OUTLET:
    return cw_values_append(values, "zones", "| %s | pressure-outlet | target mass flow rate %.9g kg/s |\n", name,
                            patch->flow_share * point->flow_rate * table->fluid.density);
  case CW_PATCH_INTERFACE:
    return cw_values_append(values, "zones", "| %s | interface | see below |\n", name);
  case CW_PATCH_SYMMETRY:
    return cw_values_append(values, "zones", "| %s | symmetry | |\n", name);
  default:
    if (cw_patch_turns(mesh, patch) == (mesh->domains[patch->domain].rotating != 0))
      return cw_values_append(values, "zones", "| %s | wall | at rest relative to its cell zone |\n", name);
    if (cw_patch_turns(mesh, patch))
      return cw_values_append(values, "zones", "| %s | wall | turns at %.9g rad/s about +z, absolute |\n", name,
                              point->speed);
    return cw_values_append(values, "zones", "| %s | wall | speed 0, absolute |\n", name);
  }
}

static CwStatus set_zones(const CwCase *table, const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  CW_TRY(cw_values_start(values, "zones"));
  for (int d = 0; d < mesh->domain_count; ++d) {
    CW_TRY(cw_values_append(values, "zones", "| %s | fluid | ", mesh->domains[d].name));
    if (mesh->domains[d].rotating)
      CW_TRY(cw_values_append(values, "zones", "frame motion, %.9g rad/s about +z through the origin |\n",
                              table->operating_point.speed));
    else
      CW_TRY(cw_values_append(values, "zones", "at rest |\n"));
  }
  for (int p = 0; p < mesh->patch_count; ++p)
    if (cw_patch_is_there(a, p)) CW_TRY(add_patch(table, mesh, &mesh->patches[p], values));
  CW_TRY(cw_values_start(values, "interfaces"));
  for (int i = 0; i < mesh->interface_count; ++i)
    CW_TRY(cw_values_append(values, "interfaces", "    /define/mesh-interfaces/create interface_%d %s () %s ()\n",
                            i + 1, mesh->patches[mesh->interfaces[i].patch[0]].name,
                            mesh->patches[mesh->interfaces[i].patch[1]].name));
done:
  return status;
}

CwStatus cw_fluent_case_write(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  static const char *const models[] = {
      [CW_K_EPSILON] = "standard k-epsilon", [CW_SST] = "k-omega SST", [CW_LAMINAR] = "none, the flow is laminar"};
  CwValues values = {0};
  CW_TRY(cw_case_values_set(table, &values));
  CW_TRY(cw_values_set(&values, "turbulence", "%s", models[cw_turbulence_model(a->mesh)]));
  CW_TRY(cw_values_set(&values, "roughness", "%.9g", cw_wall_roughness(&table->walls)));
  CW_TRY(set_zones(table, a, &values));
  CW_TRY(cw_templates_write("fluent", folder, NULL, &values));
done:
  cw_values_free(&values);
  return status;
}
