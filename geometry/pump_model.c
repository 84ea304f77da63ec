// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pump_model.h"

#include <math.h>
#include <string.h>

// Lengths along which the boundary layers grow, over the radius of the interface: a blade is a little longer than that,
// the spiral runs about three of them, the pipes some diameters.
static const double BLADE_LENGTH = 1.2, VOLUTE_LENGTH = 3, PIPE_LENGTH = 3;

typedef struct {
  CwWallFlow blade;         // blades, hub and shroud: the mean along the blade, in the passage between two blades
  CwWallFlow trailing_edge; // of the blades, before the interface
  CwWallFlow neck, volute, suction, diffuser, discharge;
} Flows;

static Flows flows_of(const CwDesign *of) {
  Flows flows;
  const double shaft = of->through_shaft_diameter > 0 ? of->through_shaft_diameter : 0;
  double narrow = fmin(fmin(of->outlet_width, of->outlet_throat_width),
                       fmin(of->inlet_passage_width, of->inlet_throat_width));
  double throat = sqrt(4 * of->throat_area / M_PI), pipe = of->inlet_diameter - shaft;
  // Between two blades: four times the section over its outline.
  flows.blade = (CwWallFlow){of->relative_speed, BLADE_LENGTH * of->interface_radius,
                             2 * of->outlet_width * of->outlet_throat_width /
                                 (of->outlet_width + of->outlet_throat_width),
                             narrow, 0};
  flows.volute =
      (CwWallFlow){of->volute_speed, VOLUTE_LENGTH * of->interface_radius, throat, fmin(of->inlet_width, throat), 0};
  flows.trailing_edge = flows.blade;
  flows.trailing_edge.before = of->interface_radius - of->outlet_diameter / 2;
  flows.neck = flows.volute;
  flows.neck.width = fmin(of->outlet_width, throat);
  // A shaft leaves a ring, half as wide.
  flows.suction =
      (CwWallFlow){of->suction_speed, PIPE_LENGTH * of->interface_radius, pipe, shaft > 0 ? pipe / 2 : pipe, 0};
  // The diffuser widens like a cone, from throat to discharge: along it the mean of Q / (pi r^2) is Q / (pi r0 r1).
  flows.diffuser = (CwWallFlow){sqrt(of->throat_speed * of->discharge_speed), PIPE_LENGTH * of->interface_radius,
                                sqrt(throat * of->discharge_diameter), fmin(throat, of->discharge_diameter), 0};
  flows.discharge = (CwWallFlow){of->discharge_speed, PIPE_LENGTH * of->interface_radius, of->discharge_diameter,
                                 of->discharge_diameter, 0};
  return flows;
}

static int starts_with(const char *text, const char *start) {
  return strncmp(text, start, strlen(start)) == 0;
}

static int is_one_of(const char *name, const char *const *names) {
  while (*names && strcmp(name, *names)) names++;
  return *names != NULL;
}

static void set_wall(const Flows *flows, CwModelPatch *patch) {
  static const char *const suction[] = {"suction_pipe", "inlet_pipe", NULL};
  static const char *const discharge[] = {"discharge", "outlet_pipe", NULL};
  static const char *const neck[] = {"neck", "step", NULL};
  const char *name = patch->name;
  CwPatchGroup group = CW_GROUP_VOLUTE;
  patch->flow = flows->volute;
  if (starts_with(name, "blade")) {
    group = CW_GROUP_BLADE;
    patch->flow = !strcmp(name, "blade_trailing_edge") ? flows->trailing_edge : flows->blade;
  } else if (starts_with(name, "hub") || starts_with(name, "shroud")) {
    group = CW_GROUP_HUB_SHROUD;
    patch->flow = flows->blade;
  } else if (is_one_of(name, neck)) {
    patch->flow = flows->neck;
  } else if (is_one_of(name, suction)) {
    group = CW_GROUP_PIPE;
    patch->flow = flows->suction;
  } else if (!strcmp(name, "diffuser")) {
    group = CW_GROUP_PIPE;
    patch->flow = flows->diffuser;
  } else if (is_one_of(name, discharge)) {
    group = CW_GROUP_PIPE;
    patch->flow = flows->discharge;
  }
  patch->group = group;
  patch->size = is_one_of(name, neck) ? CW_GROUP_INTERFACE : group;
  // The suction pipe stands still in the rotor; a shaft turns in a pipe of its own.
  if (!strcmp(name, "suction_pipe")) patch->turns = 0;
  if (!strcmp(name, "hub_shaft_pipe")) patch->turns = 1;
  patch->monitored = !strcmp(name, "tongue");
}

static CwPatchKind kind_of(const char *name) {
  int kind = 0;
  while (strcmp(name, cw_patch_kind_name((CwPatchKind)kind)) != 0) kind++;
  return (CwPatchKind)kind;
}

// Patches in the order of their first faces.
static CwStatus add_domain(const CwSolid *solid, const Flows *flows, CwModel *model) {
  CwStatus status = CW_OK;
  CW_TRY(cw_model_add_domain(model, cw_solid_domain(solid), !strcmp(cw_solid_domain(solid), "rotor")));
  for (int face = 0; face < cw_solid_face_count(solid); face++) {
    const char *name = cw_solid_face_patch(solid, face);
    CwModelPatch *patch;
    if (cw_model_patch_find(model, name) >= 0) continue;
    CW_TRY(cw_model_add_patch(model, name, kind_of(cw_solid_face_kind(solid, face)), &patch));
    if (patch->kind == CW_PATCH_WALL) set_wall(flows, patch);
  }
done:
  return status;
}

CwStatus cw_pump_model(const CwDesign *design, const CwPump *pump, CwModel *model) {
  CwStatus status = CW_OK;
  const Flows flows = flows_of(design);
  model->unit = cw_solid_unit(pump->solid[0]);
  for (int i = 0; i < pump->count; i++) CW_TRY(add_domain(pump->solid[i], &flows, model));
  for (int i = 0; i < pump->interface_count; i++) {
    const CwPumpInterface *between = &pump->interface[i];
    CW_TRY(cw_model_add_interface(model, between->patch, between->surface, design->interface_radius));
    if (between->surface == CW_SURFACE_PLANE) // before a pipe
      for (int s = 0; s < 2; s++)
        model->patch[cw_model_patch_find(model, between->patch[s])].size = CW_GROUP_PIPE;
  }
  model->flow = (CwModelFlow){design->suction_speed,   design->inlet_diameter,  design->relative_speed,
                              design->outlet_width,    design->outlet_diameter, design->blade_count};
done:
  return status;
}
