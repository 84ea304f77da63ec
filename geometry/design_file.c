// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_file.h"

#include <math.h>

#include "geometry/volute_section.h"
#include "pipeline/record.h"

static const double degree = M_PI / 180;

static json_t *solid_json(const CwMeasuredSolid *solid) {
  return json_pack("{s:b, s:b, s:i, s:f, s:f}", "valid", solid->valid, "closed", solid->closed, "faces",
                   solid->face_count, "largest_tolerance_m", solid->largest_tolerance, "volume_m3",
                   solid->volume);
}

static json_t *angle_json(const CwMeasuredAngle *angle) {
  return json_pack("{s:f, s:[f,f,f]}", "angle_deg", angle->angle / degree, "at_m", angle->at[0], angle->at[1],
                   angle->at[2]);
}

json_t *cw_measured_json(const CwMeasuredPump *measured) {
  const CwMeasuredRotor *rotor = &measured->rotor_dimensions;
  const CwMeasuredStator *stator = &measured->stator_dimensions;
  return json_pack("{s:o, s:o, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:o, s:o, s:o}", //
                   "rotor", solid_json(&measured->rotor),                                         //
                   "stator", solid_json(&measured->stator),                                       //
                   "wrap_angle_deg", rotor->wrap_angle / degree,                                  //
                   "inlet_diameter_m", rotor->inlet_diameter,                                     //
                   "outlet_diameter_m", rotor->outlet_diameter,                                   //
                   "outlet_width_m", rotor->outlet_width,                                         //
                   "base_diameter_m", stator->base_diameter,                                      //
                   "inlet_width_m", stator->inlet_width,                                          //
                   "rotor_interface_radius_m", rotor->interface_radius,                           //
                   "stator_interface_radius_m", stator->interface_radius,                         //
                   "rotor_interface_area_m2", rotor->interface_area,                              //
                   "stator_interface_area_m2", stator->interface_area,                            //
                   "least_blade_hub_angle", angle_json(&rotor->hub_crease),                       //
                   "least_blade_shroud_angle", angle_json(&rotor->shroud_crease),                 //
                   "greatest_trailing_edge_angle", angle_json(&rotor->trailing_edge));
}

// Unit in the key and scale from SI for each kind of quantity.
enum { NUMBER, LENGTH, HEAD, ANGLE, SPEED, FLOW, ANGULAR_SPEED, AREA, DIFFUSIVITY };
static const struct {
  const char *suffix;
  double scale;
} json_unit[] = {
    [NUMBER] = {"", 1},
    [LENGTH] = {"_m", 1},
    [HEAD] = {"_m", 1},
    [ANGLE] = {"_deg", 180 / M_PI},
    [SPEED] = {"_m_per_s", 1},
    [FLOW] = {"_m3_per_s", 1},
    [ANGULAR_SPEED] = {"_rad_per_s", 1},
    [AREA] = {"_m2", 1},
    [DIFFUSIVITY] = {"_m2_per_s", 1},
};

// The spiral every 45 degrees behind its start.
static json_t *sections_json(const CwVolute *volute) {
  json_t *sections = json_array();
  for (int i = 1; sections && i <= 8; i++) {
    const CwVoluteSection s = cw_volute_section(volute, i * M_PI / 4);
    json_array_append_new(sections, json_pack("{s:f, s:f, s:f, s:f, s:f}", "angle_deg", 45.0 * i, "area_m2",
                                              s.area, "outer_radius_m", s.outer_radius, "side_wall_radius_m",
                                              s.kink_radius, "side_wall_width_m", 2 * s.kink_height));
  }
  return sections;
}

CwStatus cw_design_file_write(const CwDesign *design, const CwMeasuredPump *measured, const char *path) {
  CwStatus status = CW_OK;
  static const char *const priorities[] = {
      [CW_PRIORITY_WRAP] = "wrap", [CW_PRIORITY_HEAD] = "head", [CW_PRIORITY_BETA] = "beta"};
  json_t *root = json_object(), *sources = json_object();
  int failed = !root || !sources;
  char key[80];
  failed |= json_object_set_new(root, "blade_count", json_integer(design->blade_count)) != 0;
  failed |= json_object_set_new(root, "priority", json_string(priorities[design->priority])) != 0;
#define PUT(member, kind, text)                                                                              \
  snprintf(key, sizeof key, "%s%s", #member, json_unit[kind].suffix);                                        \
  failed |= json_object_set_new(root, key, cw_json_number(design->member * json_unit[kind].scale)) != 0;     \
  failed |= json_object_set_new(sources, key, json_string(design->source[CW_DESIGN_##member])) != 0;
  CW_DESIGN_LIST(PUT)
#undef PUT
  failed |= json_object_set_new(root, "rotor_volume_m3", cw_json_number(measured->rotor.volume)) != 0;
  failed |= json_object_set_new(root, "stator_volume_m3", cw_json_number(measured->stator.volume)) != 0;
  failed |= json_object_set_new(root, "measured", cw_measured_json(measured)) != 0;
  failed |= json_object_set_new(root, "volute_sections", sections_json(&design->volute)) != 0;
  failed |= json_object_set(root, "sources", sources) != 0;
  CW_REQUIRE(!failed, CW_ERR_MEMORY, "%s: out of memory", path);
  CW_TRY(cw_json_write(root, path));
done:
  json_decref(root);
  json_decref(sources);
  return status;
}
