// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/heights/wall_targets.h"

#include <math.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/heights/layer_heights.h"
#include "pipeline/json_read.h"
#include "pipeline/wall_group.h"

CwStatus cw_flow_scales_read(const char *design_path, CwFlowScales *scales) {
  CwStatus status = CW_OK;
  json_t *design = NULL;
  CW_TRY(cw_json_read(design_path, &design));
  double outlet_radius = 0, throat_speed = 0;
  const struct {
    const char *key;
    double *value;
  } wanted[] = {{"relative_speed_m_per_s", &scales->relative_speed},   {"volute_speed_m_per_s", &scales->volute_speed},
                {"suction_speed_m_per_s", &scales->suction_speed},     {"throat_speed_m_per_s", &throat_speed},
                {"discharge_speed_m_per_s", &scales->discharge_speed}, {"interface_radius_m", &outlet_radius}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
    CW_TRY(cw_json_positive(design, design_path, wanted[i].key, wanted[i].value));
  // The diffuser widens like a cone, from throat to discharge: along it the mean of Q / (pi r^2) is Q / (pi r0 r1).
  scales->diffuser_speed = sqrt(throat_speed * scales->discharge_speed);
  // Lengths along which the boundary layers grow: a blade is a little longer than the outlet radius, the spiral runs
  // about three of them, the pipes some diameters.
  scales->blade_length = 1.2 * outlet_radius;
  scales->volute_length = 3 * outlet_radius;
  scales->pipe_length = 3 * outlet_radius;
done:
  json_decref(design);
  return status;
}

static int starts_with(const char *text, const char *start) {
  return strncmp(text, start, strlen(start)) == 0;
}

CwLayerTarget cw_layer_target(const CwCase *table, const CwWallGroup *group, double speed, double length) {
  const CwWalls *walls = &table->walls;
  CwLayerTarget target = {.first_height = group->first_height, .growth = walls->growth_ratio};
  if (cw_case_given(group->velocity)) speed = group->velocity;
  if (!cw_case_given(target.first_height)) {
    target.first_height = cw_first_height(group->y_plus, speed, length, table->fluid.kinematic_viscosity,
                                          walls->y_plus_at == CW_Y_PLUS_AT_CELL_CENTRE);
  }
  if (cw_case_given(group->growth_ratio)) target.growth = group->growth_ratio;
  // More than this would raise the first height.
  target.thickness = cw_layer_thickness(target.first_height, walls->layer_count, target.growth);
  double asked = cw_case_given(group->total_thickness) ? group->total_thickness : walls->total_thickness;
  if (cw_case_given(asked)) target.thickness = fmin(target.thickness, asked);
  return target;
}

void cw_wall_targets(const CwCad *cad, const CwCase *table, const CwFlowScales *scales, double *relative_size,
                     CwLayerTarget *layers) {
  const CwMeshTable *mesh = &table->mesh;
  for (int p = 0; p < cw_cad_patch_count(cad); p++) {
    const char *name = cw_cad_patch_name(cad, p);
    CwPatchKind kind = cw_cad_patch_kind(cad, p);
    const CwWallGroup *group = cw_wall_group(&table->walls, name);
    double speed = scales->volute_speed, length = scales->volute_length;
    relative_size[p] = mesh->size_volute;
    if (starts_with(name, "blade")) {
      relative_size[p] = mesh->size_blade;
      speed = scales->relative_speed, length = scales->blade_length;
    } else if (starts_with(name, "hub") || starts_with(name, "shroud")) {
      relative_size[p] = mesh->size_hub_shroud;
      speed = scales->relative_speed, length = scales->blade_length;
    } else if (!strcmp(name, "rotor_to_suction") || !strcmp(name, "suction_to_rotor") ||
               !strcmp(name, "stator_to_discharge") || !strcmp(name, "discharge_to_stator")) {
      relative_size[p] = mesh->size_pipe;
    } else if (kind == CW_PATCH_INTERFACE || !strcmp(name, "neck") || !strcmp(name, "step")) {
      relative_size[p] = mesh->size_interface;
    } else if (!strcmp(name, "suction_pipe") || !strcmp(name, "inlet_pipe") || kind == CW_PATCH_INLET) {
      relative_size[p] = mesh->size_pipe;
      speed = scales->suction_speed, length = scales->pipe_length;
    } else if (!strcmp(name, "diffuser")) {
      relative_size[p] = mesh->size_pipe;
      speed = scales->diffuser_speed, length = scales->pipe_length;
    } else if (!strcmp(name, "discharge") || !strcmp(name, "outlet_pipe") || kind == CW_PATCH_OUTLET) {
      relative_size[p] = mesh->size_pipe;
      speed = scales->discharge_speed, length = scales->pipe_length;
    }
    layers[p] = kind == CW_PATCH_WALL ? cw_layer_target(table, group, speed, length) : (CwLayerTarget){0};
    layers[p].first_height /= cw_model_unit();
    layers[p].thickness /= cw_model_unit();
  }
}
