// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/fluent_case.h"

#include "export/blocks.h"
#include "export/patch_role.h"

static void put_patch(FILE *out, const CwCase *table, const CwMesh *mesh, const CwModelPatch *patch) {
  const CwOperatingPoint *point = &table->operating_point;
  fprintf(out, "| %s | ", patch->name);
  switch (patch->kind) {
  case CW_PATCH_INLET:
    fprintf(out, "pressure-inlet | total pressure %.9g Pa, absolute frame |\n", point->inlet_pressure);
    break;
  case CW_PATCH_OUTLET:
    fprintf(out, "pressure-outlet | target mass flow rate %.9g kg/s |\n",
            patch->flow_share * point->flow_rate * table->fluid.density);
    break;
  case CW_PATCH_INTERFACE:
    fprintf(out, "interface | see below |\n");
    break;
  case CW_PATCH_SYMMETRY:
    fprintf(out, "symmetry | |\n");
    break;
  default:
    if (cw_patch_turns(mesh, patch) == (mesh->domains[patch->domain].rotating != 0))
      fprintf(out, "wall | at rest relative to its cell zone |\n");
    else if (cw_patch_turns(mesh, patch))
      fprintf(out, "wall | turns at %.9g rad/s about +z, absolute |\n", point->speed);
    else
      fprintf(out, "wall | speed 0, absolute |\n");
  }
}

static CwStatus set_zones(const CwCase *table, const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  CwBlocks zones = {0};
  CW_TRY(cw_blocks_open(&zones));
  for (int d = 0; d < mesh->domain_count; ++d) {
    fprintf(zones.out, "| %s | fluid | ", mesh->domains[d].name);
    if (mesh->domains[d].rotating)
      fprintf(zones.out, "frame motion, %.9g rad/s about +z through the origin |\n", table->operating_point.speed);
    else
      fprintf(zones.out, "at rest |\n");
  }
  for (int p = 0; p < mesh->patch_count; ++p)
    if (cw_patch_is_there(a, p)) put_patch(zones.out, table, mesh, &mesh->patches[p]);
  CW_TRY(cw_blocks_close(&zones, "zones", values));
  CW_TRY(cw_blocks_open(&zones));
  for (int i = 0; i < mesh->interface_count; ++i)
    fprintf(zones.out, "    /define/mesh-interfaces/create interface_%d %s () %s ()\n", i + 1,
            mesh->patches[mesh->interfaces[i].patch[0]].name, mesh->patches[mesh->interfaces[i].patch[1]].name);
  CW_TRY(cw_blocks_close(&zones, "interfaces", values));
done:
  cw_blocks_close(&zones, NULL, values);
  return status;
}

CwStatus cw_fluent_case_write(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  CwValues values = {0};
  CW_TRY(cw_values_set(&values, "case", "%s", table->name));
  CW_TRY(cw_values_set(&values, "density", "%.9g", table->fluid.density));
  CW_TRY(cw_values_set(&values, "dynamic_viscosity", "%.9g", table->fluid.density * table->fluid.kinematic_viscosity));
  CW_TRY(cw_values_set(&values, "turbulence", "%s", cw_walls_resolved(a->mesh) ? "k-omega SST" : "standard k-epsilon"));
  CW_TRY(cw_values_set(&values, "roughness", "%.9g",
                       table->walls.treatment == CW_WALL_FUNCTION_ROUGH ? table->walls.roughness : 0.0));
  CW_TRY(cw_values_set(&values, "time_step", "%.9g",
                       table->operating_point.time_step_angle / table->operating_point.speed));
  CW_TRY(set_zones(table, a, &values));
  CW_TRY(cw_templates_write("fluent/", folder, &values));
done:
  cw_values_free(&values);
  return status;
}
