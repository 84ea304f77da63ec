// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pump_model.h"

#include <math.h>
#include <string.h>

#include "geometry/wall_flow.h"

static CwWaterWay water_way(const CwDesign *of) {
  const double shaft = of->through_shaft_diameter > 0 ? of->through_shaft_diameter : 0;
  const double pipe = of->inlet_diameter - shaft;
  return (CwWaterWay){
      .radius = of->interface_radius,
      .blade_speed = of->relative_speed, // the mean along the blade
      .passage = {of->outlet_width, of->outlet_throat_width},
      .blade_width =
          fmin(fmin(of->outlet_width, of->outlet_throat_width), fmin(of->inlet_passage_width, of->inlet_throat_width)),
      .behind_blades = of->interface_radius - of->outlet_diameter / 2,
      .volute_speed = of->volute_speed,
      .volute_width = of->inlet_width,
      .neck_width = of->outlet_width,
      .suction_speed = of->suction_speed,
      .suction_diameter = pipe,
      .suction_width = shaft > 0 ? pipe / 2 : pipe, // a shaft leaves a ring
      .throat_speed = of->throat_speed,
      .throat_diameter = sqrt(4 * of->throat_area / M_PI),
      .discharge_speed = of->discharge_speed,
      .discharge_diameter = of->discharge_diameter,
  };
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

// Patches in the order of their first faces.
static CwStatus add_domain(const CwSolid *solid, const CwWallFlow *flow, CwModel *model) {
  CwStatus status = CW_OK;
  CW_TRY(cw_model_add_domain(model, cw_solid_domain(solid), !strcmp(cw_solid_domain(solid), "rotor")));
  for (int face = 0; face < cw_solid_face_count(solid); face++) {
    const char *name = cw_solid_face_patch(solid, face);
    CwModelPatch *patch;
    if (cw_model_patch_find(model, name) >= 0) continue;
    CW_TRY(cw_model_add_patch(model, name, cw_solid_face_kind(solid, face), &patch));
    if (patch->kind == CW_PATCH_WALL) set_wall(flow, patch);
  }
done:
  return status;
}

CwStatus cw_pump_model(const CwDesign *design, const CwPump *pump, CwModel *model) {
  CwStatus status = CW_OK;
  CwWallFlow flow[CW_ALONG_COUNT];
  const CwWaterWay way = water_way(design);
  cw_wall_flows(&way, flow);
  model->unit = cw_solid_unit(pump->solid[0]);
  for (int i = 0; i < pump->count; i++) CW_TRY(add_domain(pump->solid[i], flow, model));
  for (int i = 0; i < pump->interface_count; i++) {
    const CwPumpInterface *between = &pump->interface[i];
    CW_TRY(cw_model_add_interface(model, between->patch, between->surface, design->interface_radius));
    if (between->surface == CW_SURFACE_PLANE) // before a pipe
      for (int s = 0; s < 2; s++) model->patch[cw_model_patch_find(model, between->patch[s])].size = CW_GROUP_PIPE;
  }
  model->flow = (CwModelFlow){design->suction_speed, way.suction_diameter,    design->relative_speed,
                              design->outlet_width,  design->outlet_diameter, design->blade_count};
done:
  return status;
}
