// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pump_model.h"

#include <math.h>
#include <string.h>

#include "geometry/wall_name.h"

// Lengths along which the boundary layers grow, over the radius of the interface: a blade is a little longer than that,
// the spiral runs about three of them, the pipes some diameters.
static const double BLADE_LENGTH = 1.2, VOLUTE_LENGTH = 3, PIPE_LENGTH = 3;

static void set_flows(const CwDesign *of, CwWallFlow flow[CW_ALONG_COUNT]) {
  const double shaft = of->through_shaft_diameter > 0 ? of->through_shaft_diameter : 0;
  const double narrow =
      fmin(fmin(of->outlet_width, of->outlet_throat_width), fmin(of->inlet_passage_width, of->inlet_throat_width));
  const double throat = sqrt(4 * of->throat_area / M_PI), pipe = of->inlet_diameter - shaft;
  // The mean along the blade. Between two blades: four times the section over its outline.
  flow[CW_ALONG_BLADE] = (CwWallFlow){
      of->relative_speed, BLADE_LENGTH * of->interface_radius,
      2 * of->outlet_width * of->outlet_throat_width / (of->outlet_width + of->outlet_throat_width), narrow, 0};
  flow[CW_ALONG_VOLUTE] =
      (CwWallFlow){of->volute_speed, VOLUTE_LENGTH * of->interface_radius, throat, fmin(of->inlet_width, throat), 0};
  flow[CW_ALONG_TRAILING_EDGE] = flow[CW_ALONG_BLADE];
  flow[CW_ALONG_TRAILING_EDGE].before = of->interface_radius - of->outlet_diameter / 2;
  flow[CW_ALONG_NECK] = flow[CW_ALONG_VOLUTE];
  flow[CW_ALONG_NECK].width = fmin(of->outlet_width, throat);
  // A shaft leaves a ring, half as wide.
  flow[CW_ALONG_SUCTION] =
      (CwWallFlow){of->suction_speed, PIPE_LENGTH * of->interface_radius, pipe, shaft > 0 ? pipe / 2 : pipe, 0};
  // The diffuser widens like a cone, from throat to discharge: along it the mean of Q / (pi r^2) is Q / (pi r0 r1).
  flow[CW_ALONG_DIFFUSER] =
      (CwWallFlow){sqrt(of->throat_speed * of->discharge_speed), PIPE_LENGTH * of->interface_radius,
                   sqrt(throat * of->discharge_diameter), fmin(throat, of->discharge_diameter), 0};
  flow[CW_ALONG_DISCHARGE] = (CwWallFlow){of->discharge_speed, PIPE_LENGTH * of->interface_radius,
                                          of->discharge_diameter, of->discharge_diameter, 0};
}

static void set_wall(const CwWallFlow flow[CW_ALONG_COUNT], CwModelPatch *patch) {
  const CwWallName *of = cw_wall_name(patch->name);
  if (!of) of = cw_wall_name("volute");
  patch->flow = flow[of->along];
  patch->group = of->group;
  patch->size = of->size;
  if (of->turns >= 0) patch->turns = of->turns;
  patch->monitored = of->monitored;
}

static CwPatchKind kind_of(const char *name) {
  int kind = 0;
  while (strcmp(name, cw_patch_kind_name((CwPatchKind)kind)) != 0) kind++;
  return (CwPatchKind)kind;
}

// Patches in the order of their first faces.
static CwStatus add_domain(const CwSolid *solid, const CwWallFlow *flow, CwModel *model) {
  CwStatus status = CW_OK;
  CW_TRY(cw_model_add_domain(model, cw_solid_domain(solid), !strcmp(cw_solid_domain(solid), "rotor")));
  for (int face = 0; face < cw_solid_face_count(solid); face++) {
    const char *name = cw_solid_face_patch(solid, face);
    CwModelPatch *patch;
    if (cw_model_patch_find(model, name) >= 0) continue;
    CW_TRY(cw_model_add_patch(model, name, kind_of(cw_solid_face_kind(solid, face)), &patch));
    if (patch->kind == CW_PATCH_WALL) set_wall(flow, patch);
  }
done:
  return status;
}

CwStatus cw_pump_model(const CwDesign *design, const CwPump *pump, CwModel *model) {
  CwStatus status = CW_OK;
  CwWallFlow flow[CW_ALONG_COUNT];
  set_flows(design, flow);
  model->unit = cw_solid_unit(pump->solid[0]);
  for (int i = 0; i < pump->count; i++) CW_TRY(add_domain(pump->solid[i], flow, model));
  for (int i = 0; i < pump->interface_count; i++) {
    const CwPumpInterface *between = &pump->interface[i];
    CW_TRY(cw_model_add_interface(model, between->patch, between->surface, design->interface_radius));
    if (between->surface == CW_SURFACE_PLANE) // before a pipe
      for (int s = 0; s < 2; s++) model->patch[cw_model_patch_find(model, between->patch[s])].size = CW_GROUP_PIPE;
  }
  model->flow = (CwModelFlow){design->suction_speed, design->inlet_diameter,  design->relative_speed,
                              design->outlet_width,  design->outlet_diameter, design->blade_count};
done:
  return status;
}
