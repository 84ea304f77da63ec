// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/cfx_case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "export/patch_role.h"
#include "export/template.h"

typedef int (*Wanted)(const CwMeshPatch *patch);

static int is_fixed_rotor_wall(const CwMeshPatch *patch) {
  return patch->domain == CW_EXPORT_ROTOR && patch->kind == CW_KIND_WALL && !cw_patch_rotates(patch);
}

static int is_stator_wall(const CwMeshPatch *patch) {
  return patch->domain == CW_EXPORT_STATOR && patch->kind == CW_KIND_WALL;
}

// A CFX location list: the patches with faces that `wanted` picks, with commas between.
static CwStatus set_locations(const CwAssembly *a, Wanted wanted, const char *key, CwValues *values) {
  CwStatus status = CW_OK;
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  CW_REQUIRE(out, CW_ERR_MEMORY, "out of memory");
  for (int p = 0, first = 1; p < a->mesh->patch_count; ++p)
    if (wanted(&a->mesh->patches[p]) && a->patches[p].triangles + a->patches[p].quads > 0) {
      fprintf(out, "%s%s", first ? "" : ",", a->mesh->patches[p].name);
      first = 0;
    }
  fclose(out);
  CW_TRY(cw_values_set(values, key, "%s", text));
done:
  free(text);
  return status;
}

CwStatus cw_cfx_case_write(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  CwValues values = {0};
  const CwOperatingPoint *point = &table->operating_point;
  const CwMesh *mesh = a->mesh;
  CW_TRY(set_locations(a, cw_patch_rotates, "rotating_walls", &values));
  CW_TRY(set_locations(a, is_fixed_rotor_wall, "rotor_fixed_walls", &values));
  CW_TRY(set_locations(a, is_stator_wall, "stator_walls", &values));
  CW_TRY(cw_values_set(&values, "case", "%s", table->name));
  CW_TRY(cw_values_set(&values, "speed_rpm", "%.9g", point->speed * 30 / M_PI));
  CW_TRY(cw_values_set(&values, "mass_flow", "%.9g", point->flow_rate * table->fluid.density));
  CW_TRY(cw_values_set(&values, "inlet_pressure", "%.9g", point->inlet_pressure));
  CW_TRY(cw_values_set(&values, "roughness_um", "%.9g", 1e6 * table->walls.roughness));
  CW_TRY(cw_values_set(&values, "rotor_interface", "%s",
                       mesh->patches[cw_mesh_patch_of_kind(mesh, CW_EXPORT_ROTOR, CW_KIND_INTERFACE)].name));
  CW_TRY(cw_values_set(&values, "stator_interface", "%s",
                       mesh->patches[cw_mesh_patch_of_kind(mesh, CW_EXPORT_STATOR, CW_KIND_INTERFACE)].name));
  // As the paper: rough wherever there is a roughness. walls.treatment is about the wall functions of
  // OpenFOAM.
  if (table->walls.roughness > 0)
    CW_TRY(cw_values_set(&values, "wall_roughness",
                         "Option = Rough Wall\n          Sand Grain Roughness Height = %.9g [micron]",
                         1e6 * table->walls.roughness));
  else
    CW_TRY(cw_values_set(&values, "wall_roughness", "Option = Smooth Wall"));
  CW_TRY(cw_values_set(&values, "time_step_deg", "%.9g", point->time_step_angle * 180 / M_PI));
  CW_TRY(cw_values_set(&values, "density", "%.9g", table->fluid.density));
  CW_TRY(cw_values_set(&values, "dynamic_viscosity", "%.9g",
                       table->fluid.density * table->fluid.kinematic_viscosity));
  CW_TRY(cw_values_set(&values, "time_step", "%.9g", point->time_step_angle / point->speed));
  CW_TRY(cw_values_set(&values, "total_time", "%.9g", 10 * 2 * M_PI / point->speed));
  CW_TRY(cw_values_set(&values, "physical_timescale", "%.9g", 1 / point->speed));
  CW_TRY(cw_templates_write("cfx/", folder, &values));
done:
  cw_values_free(&values);
  return status;
}
