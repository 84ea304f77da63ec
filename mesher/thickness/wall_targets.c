// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/wall_targets.h"

#include <math.h>
#include <string.h>

#include "mesher/policy.h"
#include "mesher/thickness/layer_count.h"
#include "mesher/thickness/layer_thickness.h"
#include "pipeline/json_read.h"
#include "pipeline/wall_group.h"

// Lengths along which the boundary layers grow, over the radius of the interface: a blade is a little longer than that,
// the spiral runs about three of them, the pipes some diameters.
static const double BLADE_LENGTH = 1.2, VOLUTE_LENGTH = 3, PIPE_LENGTH = 3;

// Of design.json, SI.
typedef struct {
  double relative_speed, volute_speed, suction_speed, throat_speed, discharge_speed;
  double interface_radius, impeller_diameter, outlet_width, outlet_throat, inlet_width, inlet_throat, volute_width,
      throat_area;
  double eye_diameter, shaft_diameter, discharge_diameter;
} Design;

static CwStatus read_design(const char *path, Design *design) {
  CwStatus status = CW_OK;
  json_t *file = NULL;
  CW_TRY(cw_json_read(path, &file));
  const struct {
    const char *key;
    double *value;
  } wanted[] = {{"relative_speed_m_per_s", &design->relative_speed},
                {"volute_speed_m_per_s", &design->volute_speed},
                {"suction_speed_m_per_s", &design->suction_speed},
                {"throat_speed_m_per_s", &design->throat_speed},
                {"discharge_speed_m_per_s", &design->discharge_speed},
                {"interface_radius_m", &design->interface_radius},
                {"outlet_diameter_m", &design->impeller_diameter},
                {"outlet_width_m", &design->outlet_width},
                {"outlet_throat_width_m", &design->outlet_throat},
                {"inlet_passage_width_m", &design->inlet_width},
                {"inlet_throat_width_m", &design->inlet_throat},
                {"inlet_width_m", &design->volute_width},
                {"throat_area_m2", &design->throat_area},
                {"inlet_diameter_m", &design->eye_diameter},
                {"discharge_diameter_m", &design->discharge_diameter}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
    CW_TRY(cw_json_positive(file, path, wanted[i].key, wanted[i].value));
  double shaft = cw_json_real(file, "through_shaft_diameter_m");
  design->shaft_diameter = shaft > 0 ? shaft : 0;
done:
  json_decref(file);
  return status;
}

CwStatus cw_flow_scales_read(const char *design_path, CwFlowScales *scales) {
  CwStatus status = CW_OK;
  Design of = {0};
  CW_TRY(read_design(design_path, &of));
  double narrow = fmin(fmin(of.outlet_width, of.outlet_throat), fmin(of.inlet_width, of.inlet_throat));
  double throat = sqrt(4 * of.throat_area / M_PI), pipe = of.eye_diameter - of.shaft_diameter;
  // Between two blades: four times the section over its outline.
  scales->blade =
      (CwWallFlow){of.relative_speed, BLADE_LENGTH * of.interface_radius,
                   2 * of.outlet_width * of.outlet_throat / (of.outlet_width + of.outlet_throat), narrow, 0};
  scales->volute =
      (CwWallFlow){of.volute_speed, VOLUTE_LENGTH * of.interface_radius, throat, fmin(of.volute_width, throat), 0};
  scales->trailing_edge = scales->blade;
  scales->trailing_edge.before = of.interface_radius - of.impeller_diameter / 2;
  scales->neck = scales->volute;
  scales->neck.width = fmin(of.outlet_width, throat);
  // A shaft leaves a ring, half as wide.
  scales->suction = (CwWallFlow){of.suction_speed, PIPE_LENGTH * of.interface_radius, pipe,
                                 of.shaft_diameter > 0 ? pipe / 2 : pipe, 0};
  // The diffuser widens like a cone, from throat to discharge: along it the mean of Q / (pi r^2) is Q / (pi r0 r1).
  scales->diffuser = (CwWallFlow){sqrt(of.throat_speed * of.discharge_speed), PIPE_LENGTH * of.interface_radius,
                                  sqrt(throat * of.discharge_diameter), fmin(throat, of.discharge_diameter), 0};
  scales->discharge = (CwWallFlow){of.discharge_speed, PIPE_LENGTH * of.interface_radius, of.discharge_diameter,
                                   of.discharge_diameter, 0};
done:
  return status;
}

static int starts_with(const char *text, const char *start) {
  return strncmp(text, start, strlen(start)) == 0;
}

CwLayerTarget cw_layer_target(const CwCase *table, const CwWallGroup *group, double first_height, int layer_count) {
  const CwWalls *walls = &table->walls;
  double growth = cw_case_given(group->growth_ratio) ? group->growth_ratio : walls->growth_ratio;
  CwLayerTarget target = {.first_height = first_height, .growth = growth, .last = CW_LAST_LAYER_GIVEN};
  if (!cw_case_given(growth)) {
    target.growth = cw_policy.growth_auto;
    target.last = CW_LAST_LAYER;
  }
  // More than this would raise the first height.
  target.thickness = cw_layer_thickness(target.first_height, layer_count, target.growth);
  double asked = cw_case_given(group->total_thickness) ? group->total_thickness : walls->total_thickness;
  if (cw_case_given(asked)) target.thickness = fmin(target.thickness, asked);
  return target;
}

static int is_one_of(const char *name, const char *const *names) {
  while (*names && strcmp(name, *names)) names++;
  return *names != NULL;
}

void cw_patch_targets(const CwCad *cad, const CwCase *table, const CwFlowScales *scales, CwPatchTarget *target) {
  static const char *const pipe_interfaces[] = {"rotor_to_suction", "suction_to_rotor", "stator_to_discharge",
                                                "discharge_to_stator", NULL};
  static const char *const suction[] = {"suction_pipe", "inlet_pipe", NULL};
  static const char *const discharge[] = {"discharge", "outlet_pipe", NULL};
  const CwMeshTable *mesh = &table->mesh;
  for (int p = 0; p < cw_cad_patch_count(cad); p++) {
    const char *name = cw_cad_patch_name(cad, p);
    CwPatchKind kind = cw_cad_patch_kind(cad, p);
    CwPatchTarget of = {.relative_size = mesh->size_volute, .flow = scales->volute};
    if (starts_with(name, "blade")) {
      of.relative_size = mesh->size_blade;
      of.flow = !strcmp(name, "blade_trailing_edge") ? scales->trailing_edge : scales->blade;
    } else if (starts_with(name, "hub") || starts_with(name, "shroud")) {
      of.relative_size = mesh->size_hub_shroud, of.flow = scales->blade;
    } else if (is_one_of(name, pipe_interfaces)) {
      of.relative_size = mesh->size_pipe;
    } else if (kind == CW_PATCH_INTERFACE || !strcmp(name, "neck") || !strcmp(name, "step")) {
      of.relative_size = mesh->size_interface, of.flow = scales->neck;
    } else if (is_one_of(name, suction) || kind == CW_PATCH_INLET) {
      of.relative_size = mesh->size_pipe, of.flow = scales->suction;
    } else if (!strcmp(name, "diffuser")) {
      of.relative_size = mesh->size_pipe, of.flow = scales->diffuser;
    } else if (is_one_of(name, discharge) || kind == CW_PATCH_OUTLET) {
      of.relative_size = mesh->size_pipe, of.flow = scales->discharge;
    }
    target[p] = of;
  }
}
