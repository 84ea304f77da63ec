// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/cfx_case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export/patch_role.h"
#include "export/template.h"
#include "pipeline/atomic_file.h"
#include "pipeline/case_points.h"

static int is_fixed_rotor_wall(const CwMeshPatch *patch) {
  return patch->domain == CW_MESH_ROTOR && patch->kind == CW_KIND_WALL && !cw_patch_rotates(patch);
}

static int is_stator_wall(const CwMeshPatch *patch) {
  return patch->domain == CW_MESH_STATOR && patch->kind == CW_KIND_WALL;
}

// Text that grows, for blocks of which a case has as many as its mesh has domains and interfaces.
typedef struct {
  char *text;
  size_t size;
  FILE *out;
} Blocks;

static CwStatus blocks_open(Blocks *blocks) {
  CwStatus status = CW_OK;
  blocks->out = open_memstream(&blocks->text, &blocks->size);
  CW_REQUIRE(blocks->out, CW_ERR_MEMORY, "out of memory");
done:
  return status;
}

// Adds the built-in file `name`, without its first line (the licence), filled with the values.
static CwStatus blocks_add(Blocks *blocks, const char *name, const CwValues *values) {
  CwStatus status = CW_OK;
  char *filled = NULL;
  const CwTemplate *part = cw_template_find(name);
  CW_REQUIRE(part, CW_ERR_EXPORT, "no template %s", name);
  CW_TRY(cw_template_fill(name, strchr(part->text, '\n') + 1, values, &filled));
  fputs(filled, blocks->out);
done:
  free(filled);
  return status;
}

// Sets `key` to the blocks and frees them.
static CwStatus blocks_close(Blocks *blocks, const char *key, CwValues *values) {
  CwStatus status = CW_OK;
  if (!blocks->out) return status;
  int failed = fclose(blocks->out) != 0;
  CW_REQUIRE(!failed, CW_ERR_MEMORY, "out of memory");
  if (key) CW_TRY(cw_values_set(values, key, "%s", blocks->text));
done:
  free(blocks->text);
  *blocks = (Blocks){0};
  return status;
}

static int turns(const CwMesh *mesh, int interface) {
  int turning = 0;
  for (int side = 0; side < 2; ++side)
    turning |= mesh->patches[mesh->interfaces[interface].patch[side]].domain == CW_MESH_ROTOR;
  return turning;
}

// What names the two sides of an interface: its name, "ROTOR STATOR", zones and patches.
static CwStatus set_interface(const CwMesh *mesh, int interface, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMeshPatch *side[2];
  for (int s = 0; s < 2; ++s) side[s] = &mesh->patches[mesh->interfaces[interface].patch[s]];
  CW_TRY(cw_values_set(values, "zone_a", "%s", mesh->domains[side[0]->domain].zone));
  CW_TRY(cw_values_set(values, "zone_b", "%s", mesh->domains[side[1]->domain].zone));
  CW_TRY(cw_values_set(values, "between", "%s %s", mesh->domains[side[0]->domain].zone,
                       mesh->domains[side[1]->domain].zone));
  CW_TRY(cw_values_set(values, "patch_a", "%s", side[0]->name));
  CW_TRY(cw_values_set(values, "patch_b", "%s", side[1]->name));
done:
  return status;
}

// Inlet and outlet, where they lie in the domain, and its sides of interfaces.
static CwStatus set_boundaries(const CwMesh *mesh, int domain, const char *ends_key, const char *sides_key,
                               CwValues *values) {
  CwStatus status = CW_OK;
  Blocks blocks = {0};
  CW_TRY(blocks_open(&blocks));
  if (mesh->patches[cw_mesh_end(mesh, CW_KIND_INLET)].domain == domain)
    CW_TRY(blocks_add(&blocks, "cfx_parts/inlet.ccl", values));
  if (mesh->patches[cw_mesh_end(mesh, CW_KIND_OUTLET)].domain == domain)
    CW_TRY(blocks_add(&blocks, "cfx_parts/outlet.ccl", values));
  CW_TRY(blocks_close(&blocks, ends_key, values));
  CW_TRY(blocks_open(&blocks));
  for (int i = 0; i < mesh->interface_count; ++i)
    for (int side = 0; side < 2; ++side) {
      const CwMeshPatch *patch = &mesh->patches[mesh->interfaces[i].patch[side]];
      if (patch->domain != domain) continue;
      CW_TRY(set_interface(mesh, i, values));
      CW_TRY(cw_values_set(values, "side", "%d", side + 1));
      CW_TRY(cw_values_set(values, "side_patch", "%s", patch->name));
      CW_TRY(blocks_add(&blocks, "cfx_parts/interface_side.ccl", values));
    }
  CW_TRY(blocks_close(&blocks, sides_key, values));
done:
  blocks_close(&blocks, NULL, values);
  return status;
}

// The domains beside rotor and stator, each with one wall of all its wall patches, and their LES.
static CwStatus set_more_domains(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  Blocks domains = {0}, les = {0};
  CW_TRY(blocks_open(&domains));
  CW_TRY(blocks_open(&les));
  for (int d = CW_MESH_STATOR + 1; d < mesh->domain_count; ++d) {
    Blocks walls = {0}, shaft = {0};
    CW_TRY(blocks_open(&walls));
    CW_TRY(blocks_open(&shaft));
    for (int p = 0, first = 1; p < mesh->patch_count; ++p)
      if (mesh->patches[p].domain == d && mesh->patches[p].kind == CW_KIND_WALL &&
          a->patches[p].triangles + a->patches[p].quads > 0) {
        if (cw_patch_is_shaft(&mesh->patches[p])) {
          CW_TRY(cw_values_set(values, "shaft_patch", "%s", mesh->patches[p].name));
          CW_TRY(blocks_add(&shaft, "cfx_parts/shaft.ccl", values));
          continue;
        }
        fprintf(walls.out, "%s%s", first ? "" : ",", mesh->patches[p].name);
        first = 0;
      }
    CW_TRY(blocks_close(&walls, "zone_walls", values));
    CW_TRY(blocks_close(&shaft, "zone_shaft", values));
    CW_TRY(cw_values_set(values, "zone", "%s", mesh->domains[d].zone));
    CW_TRY(cw_values_set(values, "zone_wall_name", "%s walls", mesh->domains[d].name));
    CW_TRY(set_boundaries(mesh, d, "zone_ends", "zone_sides", values));
    CW_TRY(blocks_add(&domains, "cfx_parts/domain.ccl", values));
    CW_TRY(blocks_add(&les, "cfx_parts/transient_domain.ccl", values));
  }
  CW_TRY(blocks_close(&domains, "more_domains", values));
  CW_TRY(blocks_close(&les, "more_les", values));
done:
  blocks_close(&domains, NULL, values);
  blocks_close(&les, NULL, values);
  return status;
}

static CwStatus set_interfaces(const CwMesh *mesh, CwValues *values) {
  CwStatus status = CW_OK;
  Blocks steady = {0}, transient = {0};
  CW_TRY(blocks_open(&steady));
  CW_TRY(blocks_open(&transient));
  for (int i = 0; i < mesh->interface_count; ++i) {
    CW_TRY(set_interface(mesh, i, values));
    CW_TRY(blocks_add(&steady, turns(mesh, i) ? "cfx_parts/interface_turning.ccl" : "cfx_parts/interface_fixed.ccl",
                      values));
    if (turns(mesh, i)) CW_TRY(blocks_add(&transient, "cfx_parts/transient_interface_turning.ccl", values));
  }
  CW_TRY(blocks_close(&steady, "interfaces", values));
  CW_TRY(blocks_close(&transient, "transient_interfaces", values));
done:
  blocks_close(&steady, NULL, values);
  blocks_close(&transient, NULL, values);
  return status;
}

// The set-up at a flow rate (m3/s); its steady files are called `setup`.
static CwStatus set_values(const CwCase *table, const CwAssembly *a, double flow, const char *setup, CwValues *values) {
  CwStatus status = CW_OK;
  const CwOperatingPoint *point = &table->operating_point;
  const CwMesh *mesh = a->mesh;
  CW_TRY(cw_patch_names_set(a, cw_patch_rotates, ",", "rotating_walls", values));
  CW_TRY(cw_patch_names_set(a, is_fixed_rotor_wall, ",", "rotor_fixed_walls", values));
  CW_TRY(cw_patch_names_set(a, is_stator_wall, ",", "stator_walls", values));
  CW_TRY(cw_values_set(values, "case", "%s", table->name));
  CW_TRY(cw_values_set(values, "setup", "%s", setup));
  CW_TRY(cw_values_set(values, "speed_rpm", "%.9g", point->speed * 30 / M_PI));
  CW_TRY(cw_values_set(values, "mass_flow", "%.9g", flow * table->fluid.density));
  CW_TRY(cw_values_set(values, "inlet_pressure", "%.9g", point->inlet_pressure));
  CW_TRY(cw_values_set(values, "roughness_um", "%.9g", 1e6 * table->walls.roughness));
  // As the paper: rough wherever there is a roughness. walls.treatment is about the wall functions of
  // OpenFOAM.
  if (table->walls.roughness > 0)
    CW_TRY(cw_values_set(values, "wall_roughness",
                         "Option = Rough Wall\n          Sand Grain Roughness Height = %.9g [micron]",
                         1e6 * table->walls.roughness));
  else
    CW_TRY(cw_values_set(values, "wall_roughness", "Option = Smooth Wall"));
  CW_TRY(cw_values_set(values, "time_step_deg", "%.9g", point->time_step_angle * 180 / M_PI));
  CW_TRY(cw_values_set(values, "density", "%.9g", table->fluid.density));
  CW_TRY(cw_values_set(values, "dynamic_viscosity", "%.9g", table->fluid.density * table->fluid.kinematic_viscosity));
  CW_TRY(cw_values_set(values, "time_step", "%.9g", point->time_step_angle / point->speed));
  CW_TRY(cw_values_set(values, "total_time", "%.9g", 10 * 2 * M_PI / point->speed));
  CW_TRY(cw_values_set(values, "physical_timescale", "%.9g", 1 / point->speed));
  CW_TRY(set_boundaries(mesh, CW_MESH_ROTOR, "rotor_ends", "rotor_sides", values));
  CW_TRY(set_boundaries(mesh, CW_MESH_STATOR, "stator_ends", "stator_sides", values));
  CW_TRY(set_more_domains(a, values));
  CW_TRY(set_interfaces(mesh, values));
done:
  return status;
}

// The steady set-up of each point of the curve, in points/.
static CwStatus write_points(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  CwValues values = {0};
  char *path = NULL, setup[16 + CW_POINT_NAME_SIZE];
  CwCasePoint points[CW_LIST_MOST];
  const int count = cw_case_points(table, points);
  const char *const kinds[] = {"pre", "ccl"};
  CW_REQUIRE(asprintf(&path, "%s/points", folder) >= 0, CW_ERR_MEMORY, "out of memory");
  CW_TRY(cw_make_directory(path));
  for (int k = 0; k < count; ++k) {
    snprintf(setup, sizeof setup, "points/%.*s", CW_POINT_NAME_SIZE - 1, points[k].name);
    CW_TRY(set_values(table, a, points[k].flow, setup, &values));
    for (size_t kind = 0; kind < 2; ++kind) {
      char built_in[32];
      snprintf(built_in, sizeof built_in, "cfx/steady.%s", kinds[kind]);
      free(path);
      CW_REQUIRE(asprintf(&path, "%s/%s.%s", folder, setup, kinds[kind]) >= 0, CW_ERR_MEMORY, "out of memory");
      CW_TRY(cw_template_write(cw_template_find(built_in), path, &values));
    }
    cw_values_free(&values);
  }
done:
  cw_values_free(&values);
  free(path);
  return status;
}

CwStatus cw_cfx_case_write(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  CwValues values = {0};
  CW_TRY(set_values(table, a, table->operating_point.flow_rate, "steady", &values));
  CW_TRY(cw_templates_write("cfx/", folder, &values));
  CW_TRY(write_points(folder, table, a));
done:
  cw_values_free(&values);
  return status;
}
