// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "export/case_values.h"
#include "export/foam_zones.h"
#include "export/folder.h"
#include "export/template.h"
#include "pipeline/atomic_file.h"
#include "pipeline/case_points.h"
#include "pipeline/vec.h"

typedef enum { FIELD_U, FIELD_P, FIELD_K, FIELD_EPSILON, FIELD_OMEGA, FIELD_NUT } Field;

static const struct {
  const char *name, *class, *dimensions, *wall;
} fields[] = {
    [FIELD_U] = {"U", "volVectorField", "[0 1 -1 0 0 0 0]", NULL},
    [FIELD_P] = {"p", "volScalarField", "[0 2 -2 0 0 0 0]", "zeroGradient"},
    [FIELD_K] = {"k", "volScalarField", "[0 2 -2 0 0 0 0]", "kqRWallFunction"},
    [FIELD_EPSILON] = {"epsilon", "volScalarField", "[0 2 -3 0 0 0 0]", "epsilonWallFunction"},
    [FIELD_OMEGA] = {"omega", "volScalarField", "[0 0 -1 0 0 0 0]", "omegaWallFunction"},
    [FIELD_NUT] = {"nut", "volScalarField", "[0 2 -1 0 0 0 0]", NULL},
};

static const char foam_head[] = "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       %s;\n"
                                "    object      %s;\n}\n";

static CwStatus set_head(const char *name, CwValues *values) {
  return cw_values_set(values, "foam_head", foam_head, "dictionary", name);
}

// What the fields need to know.
typedef struct {
  const CwCase *table;
  const CwAssembly *assembly;
  CwTurbulence inlet, inside;
  double flow_rate; // m3/s
  int moving;       // the mesh turns in time
  int eddies;       // large eddy simulation: near walls the wall function of all y+
  int laminar;      // no fields of turbulence
} Start;

static void put_wall_velocity(FILE *out, const CwModelPatch *patch, const Start *start) {
  const CwMesh *mesh = start->assembly->mesh;
  if (cw_patch_rotates(mesh, patch) && start->moving)
    fprintf(out, "        type            movingWallVelocity;\n        value           uniform (0 0 0);\n");
  else if (cw_patch_rotates(mesh, patch)) // MRF puts the velocity of the turning wall in its place
    fprintf(out, "        type            fixedValue;\n        value           uniform (0 0 0);\n");
  else if (cw_patch_is_shaft(mesh, patch))
    fprintf(
        out,
        "        type            rotatingWallVelocity;\n        origin          (0 0 0);\n"
        "        axis            (0 0 1);\n        omega           %.9g;\n        value           uniform (0 0 0);\n",
        start->table->operating_point.speed);
  else
    fprintf(out, "        type            noSlip;\n");
}

static void put_velocity(FILE *out, const CwModelPatch *patch, const Start *start) {
  const CwPatchPart *outlet = &start->assembly->patches[patch - start->assembly->mesh->patches];
  const double flow = patch->flow_share * start->flow_rate;
  switch (patch->kind) {
  case CW_PATCH_WALL:
    put_wall_velocity(out, patch, start);
    break;
  case CW_PATCH_INLET:
    fprintf(out, "        type            pressureInletOutletVelocity;\n        value           uniform (0 0 0);\n");
    break;
  case CW_PATCH_OUTLET:
    fprintf(out,
            "        type            flowRateOutletVelocity;\n        volumetricFlowRate constant %.9g;\n"
            "        value           uniform (%.9g %.9g %.9g);\n",
            flow, flow * outlet->vector[0] / (outlet->area * outlet->area),
            flow * outlet->vector[1] / (outlet->area * outlet->area),
            flow * outlet->vector[2] / (outlet->area * outlet->area));
    break;
  case CW_PATCH_INTERFACE:
    fprintf(out, "        type            cyclicAMI;\n        value           uniform (0 0 0);\n");
    break;
  default:
    break;
  }
}

static void put_viscosity(FILE *out, const CwModelPatch *patch, const Start *start) {
  const CwWalls *walls = &start->table->walls;
  if (patch->kind != CW_PATCH_WALL)
    fprintf(out, "        type            %s;\n", patch->kind == CW_PATCH_INTERFACE ? "cyclicAMI" : "calculated");
  else if (start->eddies || cw_patch_resolved(patch))
    fprintf(out, "        type            nutUSpaldingWallFunction;\n");
  else if (walls->treatment == CW_WALL_FUNCTION_ROUGH)
    fprintf(out,
            "        type            nutkRoughWallFunction;\n        Ks              uniform %.9g;\n"
            "        Cs              uniform 0.5;\n",
            walls->roughness);
  else
    fprintf(out, "        type            nutkWallFunction;\n");
  fprintf(out, "        value           uniform 0;\n");
}

static void put_scalar(FILE *out, Field field, const CwModelPatch *patch, double inlet, double inside) {
  const char *type = "cyclicAMI";
  double value = inside;
  if (patch->kind == CW_PATCH_WALL) type = fields[field].wall;
  if (patch->kind == CW_PATCH_INLET || patch->kind == CW_PATCH_OUTLET) {
    type = "inletOutlet";
    value = inlet;
    if (field == FIELD_P) type = patch->kind == CW_PATCH_INLET ? "totalPressure" : "zeroGradient";
  }
  fprintf(out, "        type            %s;\n", type);
  if (strcmp(type, "inletOutlet") == 0) fprintf(out, "        inletValue      uniform %.9g;\n", value);
  if (strcmp(type, "totalPressure") == 0) fprintf(out, "        p0              uniform 0;\n");
  if (strcmp(type, "zeroGradient") != 0) fprintf(out, "        value           uniform %.9g;\n", value);
}

// The group of all patches between parts of a divided mesh.
static const char processor_patches[] = "    processor\n    {\n        type            processor;\n"
                                        "        value           uniform %s;\n    }\n";

// Literal values throughout: readers of such files do not expand macros.
static CwStatus write_field(const char *folder, Field field, const Start *start) {
  CwStatus status = CW_OK;
  char *path = NULL, *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  double inlet = 0, inside = 0;
  CW_REQUIRE(out, CW_ERR_MEMORY, "out of memory");
  if (field == FIELD_K) inlet = start->inlet.k, inside = start->inside.k;
  if (field == FIELD_EPSILON) inlet = start->inlet.epsilon, inside = start->inside.epsilon;
  if (field == FIELD_OMEGA) inlet = start->inlet.omega, inside = start->inside.omega;
  fprintf(out, "// SPDX-License-Identifier: AGPL-3.0-or-later\n");
  fprintf(out, foam_head, fields[field].class, fields[field].name);
  fprintf(out, "\ndimensions      %s;\ninternalField   uniform ", fields[field].dimensions);
  char uniform[32] = "(0 0 0)";
  if (field != FIELD_U) snprintf(uniform, sizeof uniform, "%.9g", inside);
  fprintf(out, "%s;\nboundaryField\n{\n", uniform);
  for (int p = 0; p < start->assembly->mesh->patch_count; ++p) {
    const CwModelPatch *patch = &start->assembly->mesh->patches[p];
    if (!cw_patch_is_there(start->assembly, p)) continue;
    fprintf(out, "    %s\n    {\n", patch->name);
    if (patch->kind == CW_PATCH_SYMMETRY)
      fprintf(out, "        type            symmetry;\n");
    else if (field == FIELD_U)
      put_velocity(out, patch, start);
    else if (field == FIELD_NUT)
      put_viscosity(out, patch, start);
    else
      put_scalar(out, field, patch, inlet, inside);
    fprintf(out, "    }\n");
  }
  if (start->table->output.foam_processors > 1) fprintf(out, processor_patches, uniform);
  fprintf(out, "}\n");
  CW_REQUIRE(fflush(out) == 0, CW_ERR_MEMORY, "out of memory");
  CW_TRY(cw_path_set(&path, "%s/%s", folder, fields[field].name));
  CW_TRY(cw_text_write(path, text, 0));
done:
  if (out) fclose(out);
  free(path);
  free(text);
  return status;
}

// checkMesh needs 1 GB for a million cells on one rank, and on several as much together; the solver 2 GB.
const char *cw_foam_usual_ranks(int64_t cells) {
  return cells > 20000000 ? "$(nproc)" : "1";
}

// What follows from the release and from the number of processors. Debian's v1912 has no scotch.
static CwStatus set_release(const CwCase *table, CwValues *values) {
  CwStatus status = CW_OK;
  const int processors = table->output.foam_processors > 1 ? table->output.foam_processors : 2;
  const int is_old = table->output.foam_release == CW_FOAM_V1912;
  CW_TRY(cw_values_set(values, "release", "%s", is_old ? "v1912" : "v2406"));
  CW_TRY(cw_values_set(values, "tried", "%s",
                       is_old ? "" : " The keywords follow its documentation; this case has not been run with it."));
  CW_TRY(cw_values_set(values, "environment", "%s",
                       is_old ? "export WM_PROJECT_DIR=/usr/share/openfoam   # where the package keeps its etc/ folder"
                              : ". /usr/lib/openfoam/openfoam2406/etc/bashrc"));
  CW_TRY(
      cw_values_set(values, "project_folder", "%s", is_old ? "/usr/share/openfoam" : "/usr/lib/openfoam/openfoam2406"));
  CW_TRY(cw_values_set(values, "processors", "%d", processors));
  CW_TRY(cw_values_set_file(values, "decomposition", is_old ? "openfoam_parts/hierarchical" : "openfoam_parts/scotch"));
done:
  return status;
}

static CwStatus set_turbulence(CwTurbulenceModel model, CwValues *values) {
  CwStatus status = CW_OK;
  static const char *const names[] = {[CW_K_EPSILON] = "kEpsilon", [CW_SST] = "kOmegaSST", [CW_LAMINAR] = "none"};
  const int laminar = model == CW_LAMINAR;
  CW_TRY(cw_values_set(values, "turbulence_model", "%s", names[model]));
  CW_TRY(cw_values_set(values, "solved_fields", "%s", laminar ? "U p" : "U p \"(k|epsilon|omega)\""));
  CW_TRY(cw_values_set_file(values, "turbulence",
                            laminar ? "openfoam_parts/turbulence_laminar" : "openfoam_parts/turbulence_ras"));
  CW_TRY(cw_values_set(values, "turbulence_words", "%s%s", names[model],
                       laminar
                           ? ", the flow along all walls is laminar"
                           : ". Wall functions in `0/nut` follow from the y+ targets and the roughness of the case"));
  CW_TRY(cw_values_start(values, "omega_function"));
  if (model == CW_K_EPSILON) CW_TRY(cw_values_append_file(values, "omega_function", "openfoam_parts/omega_function"));
  CW_TRY(cw_values_set(values, "eddies_words", "%s",
                       laminar ? "" : ", and `les/` goes on from it with a large eddy simulation"));
  CW_TRY(cw_values_set(values, "eddies_after", "%s",
                       laminar ? "" : "`../les` goes on from it with a large eddy simulation.\n"));
done:
  return status;
}

static CwStatus set_values(const CwCase *table, const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  CW_TRY(cw_case_values_set(table, values));
  CW_TRY(cw_values_set(values, "usual_ranks", "%s", cw_foam_usual_ranks(cw_assembly_cells(a))));
  CW_TRY(cw_patch_names_set(a, -1, cw_patch_turns, " ", "rotating_walls", values));
  CW_TRY(set_turbulence(cw_turbulence_model(a->mesh), values));
  CW_TRY(cw_values_set(values, "report_interval", "10"));
  CW_TRY(set_release(table, values));
  CW_TRY(cw_foam_zones_set(a, values));
done:
  return status;
}

static int is_blade(const CwMesh *mesh, const CwModelPatch *patch) {
  return patch->kind == CW_PATCH_WALL && patch->group == CW_GROUP_BLADE;
}

// The mean pressure of walls that are monitored.
static CwStatus set_monitored(const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  CW_TRY(cw_values_start(values, "monitored_pressures"));
  for (int p = 0; p < a->mesh->patch_count; ++p) {
    if (!a->mesh->patches[p].monitored || !cw_patch_is_there(a, p)) continue;
    CW_TRY(cw_values_set(values, "patch", "%s", a->mesh->patches[p].name));
    CW_TRY(cw_values_append_file(values, "monitored_pressures", "openfoam_parts/monitored_pressure"));
  }
done:
  return status;
}

// What the large eddy simulation asks beyond the other cases. A phase is a position of the blades to the tongue: it
// comes again after a pitch, or where a pitch is no whole number of steps, after a turn.
static CwStatus set_eddy_values(const CwCase *table, const CwAssembly *a, CwValues *values) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  const double turn = 2 * M_PI, most = CW_DEGREE;
  // As many steps a turn as the case asks, but of one degree at the most.
  const double steps = round(turn / fmin(table->operating_point.time_step_angle, most));
  const double pitch = steps / mesh->flow.blade_count;
  CW_TRY(cw_values_set(values, "les_step", "%.9g", turn / steps / table->operating_point.speed));
  CW_TRY(cw_values_set(values, "les_step_deg", "%.9g", 360 / steps));
  CW_TRY(cw_values_set(values, "turn_time", "%.9g", turn / table->operating_point.speed));
  CW_TRY(cw_values_set(values, "phase_steps", "%.0f", pitch == floor(pitch) ? pitch : steps));
  CW_TRY(cw_values_set(values, "les_delta", cw_turbulence_model(mesh) != CW_K_EPSILON ? "vanDriest" : "cubeRootVol"));
  CW_TRY(cw_patch_names_set(a, -1, is_blade, " ", "blades", values));
  CW_TRY(set_monitored(a, values));
done:
  return status;
}

// The fields at time 0 of a case into the folder `folder`/`part`/0.
static CwStatus write_fields(const char *folder, const char *part, const Start *start) {
  CwStatus status = CW_OK;
  char *path = NULL;
  CW_TRY(cw_path_set(&path, "%s/%s/0", folder, part));
  CW_TRY(cw_make_directory(path));
  for (size_t f = 0; f < sizeof fields / sizeof *fields; ++f) {
    const int transported = f == FIELD_K || f == FIELD_EPSILON || f == FIELD_OMEGA;
    const int turbulent = transported || f == FIELD_NUT;
    if (!(start->eddies && transported) && !(start->laminar && turbulent)) CW_TRY(write_field(path, (Field)f, start));
  }
done:
  free(path);
  return status;
}

// What the fields start from at a flow rate (m3/s).
static Start start_at(double flow, const CwCase *table, const CwAssembly *a) {
  const double share = flow / table->operating_point.flow_rate;
  const CwModelFlow *of = &a->mesh->flow;
  Start start = {.table = table,
                 .assembly = a,
                 .flow_rate = flow,
                 .laminar = cw_turbulence_model(a->mesh) == CW_LAMINAR,
                 .inlet = cw_turbulence(share * of->inlet_speed, of->inlet_diameter),
                 .inside = cw_turbulence(of->passage_speed, of->passage_width)};
  return start;
}

// Gives the folder of a case whose mesh is divided the folders of its parts, processorN, each with a link to the start
// fields of the case, which are uniform and so those of every part. `above`: the way from there to the case that has
// the mesh, for a link to its constant; NULL: this is that case.
static CwStatus link_parts(const char *folder, int count, const char *above) {
  CwStatus status = CW_OK;
  char *part = NULL, *link = NULL, *target = NULL;
  for (int p = 0; p < count; ++p) {
    CW_TRY(cw_path_set(&part, "%s/processor%d", folder, p));
    CW_TRY(cw_make_directory(part));
    CW_TRY(cw_path_set(&link, "%s/0", part));
    CW_TRY(cw_link_make(link, "../0"));
    if (!above) continue;
    CW_TRY(cw_path_set(&link, "%s/constant", part));
    CW_TRY(cw_path_set(&target, "%s/processor%d/constant", above, p));
    CW_TRY(cw_link_make(link, target));
  }
done:
  free(part);
  free(link);
  free(target);
  return status;
}

// A steady case for each point of the curve, points/NAME: fields of its own, all else is that of the operating point.
static CwStatus write_points(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  static const char *const shared[] = {"constant", "system", "Allrun", "run_solver.sh", "Allclean", "summary"};
  char *point = NULL, *link = NULL;
  CwCasePoint points[CW_LIST_MOST];
  const int count = cw_case_points(table, points);
  for (int k = 0; k < count; ++k) {
    CW_TRY(cw_path_set(&point, "%s/points/%s", folder, points[k].name));
    CW_TRY(cw_make_directory(point));
    const Start start = start_at(points[k].flow, table, a);
    CW_TRY(write_fields(point, ".", &start));
    for (size_t i = 0; i < sizeof shared / sizeof *shared; ++i) {
      char target[32];
      snprintf(target, sizeof target, "../../%s", shared[i]);
      CW_TRY(cw_path_set(&link, "%s/%s", point, shared[i]));
      CW_TRY(cw_link_make(link, target));
    }
    if (table->output.foam_processors > 1) CW_TRY(link_parts(point, table->output.foam_processors, "../../.."));
  }
done:
  free(point);
  free(link);
  return status;
}

// A case in the folder `name` of the steady one, which uses its mesh: the built-in files in `templates`, NULL where
// they are there, and its fields.
static CwStatus write_case_in_time(const char *folder, const char *name, const char *templates, const Start *start,
                                   CwValues *values) {
  CwStatus status = CW_OK;
  const int processors = start->table->output.foam_processors;
  char *path = NULL;
  CW_TRY(cw_path_set(&path, "%s/%s", folder, name));
  if (templates) CW_TRY(cw_templates_write(templates, path, set_head, values));
  CW_TRY(write_fields(folder, name, start));
  if (processors > 1) CW_TRY(link_parts(path, processors, "../.."));
done:
  free(path);
  return status;
}

CwStatus cw_foam_case_write(const char *folder, const CwCase *table, const CwAssembly *a) {
  CwStatus status = CW_OK;
  CwValues values = {0};
  Start start = start_at(table->operating_point.flow_rate, table, a);
  CW_TRY(set_values(table, a, &values));
  CW_TRY(set_eddy_values(table, a, &values));
  CW_TRY(cw_templates_write("openfoam", folder, set_head, &values));
  CW_TRY(write_fields(folder, ".", &start));
  if (table->output.foam_processors > 1) CW_TRY(link_parts(folder, table->output.foam_processors, NULL));
  start.moving = 1;
  CW_TRY(write_case_in_time(folder, "transient", NULL, &start, &values));
  start.eddies = 1;
  if (!start.laminar) CW_TRY(write_case_in_time(folder, "les", "openfoam_les", &start, &values));
  CW_TRY(write_points(folder, table, a));
done:
  cw_values_free(&values);
  return status;
}
