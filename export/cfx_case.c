// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/cfx_case.h"

#include <math.h>
#include <stdlib.h>

#include "export/case_values.h"
#include "export/folder.h"
#include "export/interface.h"
#include "export/patch_role.h"
#include "pipeline/case_points.h"

// What names the two sides of an interface: its name, "ROTOR STATOR", "ROTOR STATOR 2", ..., zones and patches.
static CwStatus set_interface(const CwMesh *mesh, int interface, CwValues *values) {
  CwStatus status = CW_OK;
  const CwModelPatch *side[2];
  const int before = cw_interfaces_before(mesh, interface, 0);
  for (int s = 0; s < 2; ++s) side[s] = &mesh->patches[mesh->interfaces[interface].patch[s]];
  CW_TRY(cw_values_set(values, "zone_a", "%s", mesh->domains[side[0]->domain].zone));
  CW_TRY(cw_values_set(values, "zone_b", "%s", mesh->domains[side[1]->domain].zone));
  CW_TRY(cw_values_set(values, "between", "%s %s", mesh->domains[side[0]->domain].zone,
                       mesh->domains[side[1]->domain].zone));
  if (before) CW_TRY(cw_values_append(values, "between", " %d", before + 1));
  CW_TRY(cw_values_set(values, "patch_a", "%s", side[0]->name));
  CW_TRY(cw_values_set(values, "patch_b", "%s", side[1]->name));
done:
  return status;
}

// Inlets, outlets and planes of symmetry of the domain, and its sides of interfaces.
static CwStatus set_boundaries(const CwMesh *mesh, int domain, double mass_flow, CwValues *values) {
  CwStatus status = CW_OK;
  static const char *const parts[] = {[CW_PATCH_INLET] = "cfx_parts/inlet.ccl",
                                      [CW_PATCH_OUTLET] = "cfx_parts/outlet.ccl",
                                      [CW_PATCH_SYMMETRY] = "cfx_parts/symmetry.ccl"};
  // In a rotating zone the frame is told.
  const int rotating = mesh->domains[domain].rotating;
  CW_TRY(cw_values_set(values, "end_frame", "%s", rotating ? "      Frame Type = Stationary\n" : ""));
  CW_TRY(cw_values_set(values, "end_pressure", "%s", rotating ? "Stationary Frame Total Pressure" : "Total Pressure"));
  CW_TRY(cw_values_start(values, "zone_ends"));
  CW_TRY(cw_values_start(values, "zone_sides"));
  for (int kind = 0; kind < CW_PATCH_KINDS; ++kind)
    for (int p = 0; p < mesh->patch_count; ++p) {
      const CwModelPatch *patch = &mesh->patches[p];
      if (patch->domain != domain || (int)patch->kind != kind || !parts[kind]) continue;
      CW_TRY(cw_values_set(values, "end", "%s", patch->name));
      CW_TRY(cw_values_set(values, "end_mass_flow", "%.9g", mass_flow * patch->flow_share));
      CW_TRY(cw_values_append_file(values, "zone_ends", parts[kind]));
    }
  for (int i = 0; i < mesh->interface_count; ++i)
    for (int side = 0; side < 2; ++side) {
      const CwModelPatch *patch = &mesh->patches[mesh->interfaces[i].patch[side]];
      if (patch->domain != domain) continue;
      CW_TRY(set_interface(mesh, i, values));
      CW_TRY(cw_values_set(values, "side", "%d", side + 1));
      CW_TRY(cw_values_set(values, "side_patch", "%s", patch->name));
      CW_TRY(cw_values_append_file(values, "zone_sides", "cfx_parts/interface_side.ccl"));
    }
done:
  return status;
}

static CwPatchChoice walls_that(int turn) {
  return turn ? cw_patch_turns : cw_patch_stands;
}

// Whether no domain before this one, rotating or not as it is, has walls that turn, or do not.
static int is_first(const CwMesh *mesh, int domain, int turning) {
  for (int p = 0; p < mesh->patch_count; ++p) {
    const CwModelPatch *patch = &mesh->patches[p];
    if (patch->domain < domain && walls_that(turning)(mesh, patch) &&
        !mesh->domains[patch->domain].rotating == !mesh->domains[domain].rotating)
      return 0;
  }
  return 1;
}

// Sets "wall_name", what the boundary of a domain's walls is called that turn, or do not. The first ones have names of
// their own.
static CwStatus set_wall_name(const CwMesh *mesh, int domain, int turning, CwValues *values) {
  const CwMeshDomain *of = &mesh->domains[domain];
  const int first = is_first(mesh, domain, turning), alone = first && (turning || !of->rotating);
  const char *what = turning        ? (of->rotating ? "impeller" : "shaft")
                     : of->rotating ? "fixed walls"
                     : first        ? "casing"
                                    : "walls";
  return cw_values_set(values, "wall_name", "%s%s%s", alone ? "" : of->name, alone ? "" : " ", what);
}

// Adds the walls of a domain that turn, or do not, as one boundary; none where it has none.
static CwStatus add_walls(const CwAssembly *a, int domain, int turning, CwValues *values) {
  CwStatus status = CW_OK;
  const int rotating = a->mesh->domains[domain].rotating != 0;
  if (!cw_patch_count(a, domain, walls_that(turning))) return CW_OK;
  CW_TRY(cw_patch_names_set(a, domain, walls_that(turning), ",", "wall_patches", values));
  CW_TRY(set_wall_name(a->mesh, domain, turning, values));
  CW_TRY(cw_values_set(values, "frame_type", "%s", rotating ? "      Frame Type = Rotating\n" : ""));
  CW_TRY(cw_values_start(values, "wall_velocity"));
  if (rotating != turning)
    CW_TRY(cw_values_append_file(values, "wall_velocity",
                                 rotating ? "cfx_parts/velocity_counter.ccl" : "cfx_parts/velocity_shaft.ccl"));
  CW_TRY(cw_values_append_file(values, "zone_wall_boundaries", "cfx_parts/wall.ccl"));
done:
  return status;
}

// Sets a value to a file, or to nothing.
static CwStatus set_file_if(int there, const char *key, const char *path, CwValues *values) {
  return there ? cw_values_set_file(values, key, path) : cw_values_start(values, key);
}

// The set-up of turbulence that the domains share: what is transported has values at inlets and interfaces, and what a
// wall function takes is there where there is one.
static CwStatus set_turbulence(const CwCase *table, CwTurbulenceModel model, int transient, CwValues *values) {
  CwStatus status = CW_OK;
  static const char *const names[] = {[CW_K_EPSILON] = "k-epsilon", [CW_SST] = "SST", [CW_LAMINAR] = "laminar"};
  static const char *const parts[] = {[CW_K_EPSILON] = "cfx_parts/turbulence_k_epsilon.ccl",
                                      [CW_SST] = "cfx_parts/turbulence_sst.ccl",
                                      [CW_LAMINAR] = "cfx_parts/turbulence_laminar.ccl"};
  const int laminar = model == CW_LAMINAR, transported = !laminar && !transient;
  const char *eddies = laminar ? names[model] : "LES Smagorinsky";
  CW_TRY(cw_values_set(values, "steady_model", "%s", names[model]));
  CW_TRY(cw_values_set(values, "transient_model", "%s", eddies));
  CW_TRY(cw_values_set(values, "flow", "%s, %s",
                       transient ? "transient rotor/stator from a steady result" : "frozen rotor",
                       transient ? eddies : names[model]));
  CW_TRY(
      cw_values_set_file(values, "turbulence", transient && !laminar ? "cfx_parts/turbulence_les.ccl" : parts[model]));
  CW_TRY(set_file_if(transported, "turbulence_inlet", "cfx_parts/turbulence_inlet.ccl", values));
  CW_TRY(set_file_if(transported, "turbulence_interface", "cfx_parts/turbulence_interface.ccl", values));
  CW_TRY(set_file_if(transported, "turbulence_numerics", "cfx_parts/turbulence_numerics.ccl", values));
  CW_TRY(cw_values_set(values, "transient_advection", "%s", laminar ? "High Resolution" : "Central Difference"));
  CW_TRY(cw_values_set(values, "roughness_um", "%.9g", 1e6 * table->walls.roughness));
  // As the paper: rough wherever there is a roughness. walls.treatment is about the wall functions of OpenFOAM.
  CW_TRY(set_file_if(!laminar, "wall_roughness",
                     table->walls.roughness > 0 ? "cfx_parts/wall_rough.ccl" : "cfx_parts/wall_smooth.ccl", values));
done:
  return status;
}

static CwStatus set_domains(const CwAssembly *a, double mass_flow, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  CW_TRY(cw_values_start(values, "domains"));
  for (int d = 0; d < mesh->domain_count; ++d) {
    const int rotating = mesh->domains[d].rotating != 0;
    CW_TRY(cw_values_start(values, "zone_wall_boundaries"));
    CW_TRY(add_walls(a, d, rotating, values));
    CW_TRY(add_walls(a, d, !rotating, values));
    CW_TRY(cw_values_set(values, "zone", "%s", mesh->domains[d].zone));
    CW_TRY(set_boundaries(mesh, d, mass_flow, values));
    CW_TRY(cw_values_set_file(values, "domain_motion",
                              rotating ? "cfx_parts/motion_rotating.ccl" : "cfx_parts/motion_stationary.ccl"));
    CW_TRY(cw_values_append_file(values, "domains", "cfx_parts/domain.ccl"));
  }
done:
  return status;
}

// The mean total pressure of inlets or outlets, weighted by their flows, and what flows through all of them.
static CwStatus set_ends(const CwMesh *mesh, CwPatchKind kind, const char *pressure_key, const char *flow_key,
                         CwValues *values) {
  CwStatus status = CW_OK;
  const char *mean = "massFlowAve(Total Pressure in Stn Frame)";
  const int count = cw_patch_kind_count(mesh, kind);
  int written = 0;
  CW_TRY(cw_values_set(values, pressure_key, "%s", count > 1 ? "(" : ""));
  CW_TRY(cw_values_set(values, flow_key, "%s", count > 1 ? "(" : ""));
  for (int p = 0; p < mesh->patch_count; ++p) {
    if (mesh->patches[p].kind != kind) continue;
    const char *name = mesh->patches[p].name, *between = written++ ? " + " : "";
    CW_TRY(cw_values_append(values, pressure_key, "%s%s@%s", between, mean, name));
    if (count > 1) CW_TRY(cw_values_append(values, pressure_key, " * massFlow()@%s", name));
    CW_TRY(cw_values_append(values, flow_key, "%smassFlow()@%s", between, name));
  }
  if (count > 1) {
    CW_TRY(cw_values_append(values, flow_key, ")"));
    CW_TRY(cw_values_append(values, pressure_key, ") / %s", cw_values_get(values, flow_key)));
  }
done:
  return status;
}

// Of the water on all boundaries that turn.
static CwStatus set_torque(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  int count = 0;
  CW_TRY(cw_values_start(values, "torque"));
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    if (!cw_patch_count(a, d, cw_patch_turns)) continue;
    CW_TRY(set_wall_name(a->mesh, d, 1, values));
    CW_TRY(
        cw_values_append(values, "torque", "%s-torque_z()@%s", count++ ? " " : "", cw_values_get(values, "wall_name")));
  }
  if (!count) CW_TRY(cw_values_set(values, "torque", "0 [N m]"));
done:
  return status;
}

// Mean and greatest y+ of each boundary of walls, as expressions and as monitors of these. Laminar flow has none.
static CwStatus set_y_plus(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  static const char *const kinds[][2] = {{"mean", "areaAve"}, {"greatest", "maxVal"}};
  CW_TRY(cw_values_start(values, "y_plus_expressions"));
  CW_TRY(cw_values_start(values, "y_plus_monitors"));
  for (int wall = 0; wall < 2 * a->mesh->domain_count && cw_turbulence_model(a->mesh) != CW_LAMINAR; ++wall) {
    if (!cw_patch_count(a, wall / 2, walls_that(wall % 2))) continue;
    CW_TRY(set_wall_name(a->mesh, wall / 2, wall % 2, values));
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
      CW_TRY(cw_values_set(values, "y_plus", "%s", kinds[k][0]));
      CW_TRY(cw_values_set(values, "function", "%s", kinds[k][1]));
      CW_TRY(cw_values_append_file(values, "y_plus_expressions", "cfx_parts/y_plus_expression.ccl"));
      CW_TRY(cw_values_append_file(values, "y_plus_monitors", "cfx_parts/y_plus_monitor.ccl"));
    }
  }
done:
  return status;
}

static CwStatus set_interfaces(const CwMesh *mesh, int transient, CwValues *values) {
  CwStatus status = CW_OK;
  CW_TRY(cw_values_start(values, "interfaces"));
  for (int i = 0; i < mesh->interface_count; ++i) {
    int rotating[2];
    for (int side = 0; side < 2; ++side)
      rotating[side] = mesh->domains[mesh->patches[mesh->interfaces[i].patch[side]].domain].rotating;
    const int turning = !rotating[0] != !rotating[1]; // zones that turn together have one frame
    CW_TRY(set_interface(mesh, i, values));
    CW_TRY(cw_values_set(values, "frame_change", "%s",
                         !turning    ? "None"
                         : transient ? "Transient Rotor Stator"
                                     : "Frozen Rotor"));
    CW_TRY(cw_values_set_file(values, "pitch_change",
                              turning ? "cfx_parts/pitch_turning.ccl" : "cfx_parts/pitch_none.ccl"));
    CW_TRY(cw_values_append_file(values, "interfaces", "cfx_parts/interface.ccl"));
  }
done:
  return status;
}

// What steady and transient set-ups differ in beside turbulence and interfaces.
static CwStatus set_time(const CwCase *table, int transient, CwValues *values) {
  CwStatus status = CW_OK;
  const double turn = 2 * M_PI / table->operating_point.time_step_angle; // steps
  CW_TRY(cw_values_set(values, "turn_steps", "%.0f", round(turn)));
  // The first time step after half of the ten turns.
  CW_TRY(cw_values_set(values, "means_from", "%.0f", 1 + round(5 * turn)));
  CW_TRY(cw_values_set(values, "physical_timescale", "%.9g", 1 / table->operating_point.speed));
  CW_TRY(cw_values_set_file(values, "time", transient ? "cfx_parts/transient_time.ccl" : "cfx_parts/steady_time.ccl"));
  CW_TRY(set_file_if(transient, "transient_output", "cfx_parts/transient_output.ccl", values));
  CW_TRY(cw_values_set_file(values, "solver",
                            transient ? "cfx_parts/transient_solver.ccl" : "cfx_parts/steady_solver.ccl"));
done:
  return status;
}

static CwStatus set_values(const CwCase *table, const CwAssembly *a, double flow, int transient, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  CW_TRY(cw_case_values_set(table, values));
  CW_TRY(cw_values_set(values, "mass_flow", "%.9g", flow * table->fluid.density));
  CW_TRY(cw_values_set(values, "temperature", "%.9g",
                       cw_case_given(table->fluid.temperature) ? table->fluid.temperature : 20));
  CW_TRY(set_turbulence(table, cw_turbulence_model(mesh), transient, values));
  CW_TRY(set_time(table, transient, values));
  CW_TRY(set_domains(a, flow * table->fluid.density, values));
  CW_TRY(set_ends(mesh, CW_PATCH_INLET, "inlet_pressure_mean", "inlet_mass_flow", values));
  CW_TRY(set_ends(mesh, CW_PATCH_OUTLET, "outlet_pressure", "outlet_mass_flow", values));
  CW_TRY(set_torque(a, values));
  CW_TRY(set_y_plus(a, values));
  CW_TRY(set_interfaces(mesh, transient, values));
done:
  return status;
}

// The files of a set-up at a flow rate (m3/s), `setup`.ccl and `setup`.pre.
static CwStatus write_setup(const char *folder, const char *setup, const CwCase *table, const CwAssembly *a,
                            double flow, int transient) {
  CwStatus status = CW_OK;
  CwValues values = {0};
  char *path = NULL;
  CW_TRY(set_values(table, a, flow, transient, &values));
  CW_TRY(cw_values_set(&values, "setup", "%s", setup));
  CW_TRY(cw_path_set(&path, "%s/%s", folder, setup));
  CW_TRY(cw_templates_write("cfx/setup", path, NULL, &values));
done:
  cw_values_free(&values);
  free(path);
  return status;
}

CwStatus cw_cfx_case_write(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  CwValues values = {0};
  const double flow = table->operating_point.flow_rate;
  char *path = NULL;
  CwCasePoint points[CW_LIST_MOST];
  const int count = cw_case_points(table, points);
  CW_TRY(write_setup(folder, "steady", table, a, flow, 0));
  CW_TRY(write_setup(folder, "transient", table, a, flow, 1));
  for (int k = 0; k < count; ++k) {
    CW_TRY(cw_path_set(&path, "points/%s", points[k].name));
    CW_TRY(write_setup(folder, path, table, a, points[k].flow, 0));
  }
  CW_TRY(set_values(table, a, flow, 0, &values));
  CW_TRY(cw_path_set(&path, "%s/README", folder));
  CW_TRY(cw_templates_write("cfx/README", path, NULL, &values));
done:
  cw_values_free(&values);
  free(path);
  return status;
}
