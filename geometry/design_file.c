// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "geometry/correlations.h"
#include "geometry/design_check.h"
#include "geometry/design_value.h"
#include "geometry/volute_section.h"
#include "pipeline/case_schema.h"
#include "pipeline/record.h"

static json_t *angle_json(const CwMeasuredAngle *angle) {
  return json_pack("{s:f, s:[f,f,f]}", "angle_deg", angle->angle / CW_DEGREE, "at_m", angle->at[0], angle->at[1],
                   angle->at[2]);
}

static json_t *solid_json(const CwMeasuredSolid *solid) {
  return json_pack("{s:b, s:b, s:i, s:f, s:f, s:f, s:f, s:o, s:o, s:o}",     //
                   "valid", solid->valid,                                    //
                   "closed", solid->closed,                                  //
                   "faces", solid->face_count,                               //
                   "largest_tolerance_m", solid->largest_tolerance,          //
                   "volume_m3", solid->volume,                               //
                   "shortest_edge_m", solid->shortest_edge,                  //
                   "narrowest_face_m", solid->narrowest_face,                //
                   "sharpest_edge_of_fluid", angle_json(&solid->fluid_edge), //
                   "sharpest_edge_of_wall", angle_json(&solid->wall_edge),   //
                   "sharpest_corner", angle_json(&solid->corner));
}

json_t *cw_measured_json(const CwMeasuredPump *measured) {
  const CwMeasuredRotor *rotor = &measured->rotor;
  const CwMeasuredStator *stator = &measured->stator;
  return json_pack("{s:o, s:o, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:o, s:o, s:o}", //
                   "rotor", solid_json(&measured->solid[CW_PUMP_ROTOR]),                          //
                   "stator", solid_json(&measured->solid[CW_PUMP_STATOR]),                        //
                   "wrap_angle_deg", rotor->wrap_angle / CW_DEGREE,                               //
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

static json_t *triangle_json(const char *station, double span, const CwTriangle *t) {
  return json_pack("{s:s, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "station", station, "span", span,
                   "radius_m", t->radius, "u_m_per_s", t->u, "c_m_m_per_s", t->c_m, "c_u_m_per_s", t->c_u, "c_m_per_s",
                   t->c, "w_m_per_s", t->w, "flow_angle_deg", t->flow_angle / CW_DEGREE, "blade_angle_deg",
                   t->blade_angle / CW_DEGREE, "incidence_or_deviation_deg",
                   (t->blade_angle - t->flow_angle) / CW_DEGREE);
}

static json_t *triangles_json(const CwDesign *design) {
  json_t *list = json_array();
  int failed = !list;
  for (int j = 0; j < CW_TRIANGLE_SPANS; j++) {
    const double span = (double)j / (CW_TRIANGLE_SPANS - 1);
    failed |= json_array_append_new(list, triangle_json("inlet", span, &design->inlet_triangle[j])) != 0;
    failed |= json_array_append_new(list, triangle_json("outlet", span, &design->outlet_triangle[j])) != 0;
  }
  if (failed) {
    json_decref(list);
    return NULL;
  }
  return list;
}

// What both families give for each correlated quantity, in the unit of its key.
static json_t *correlations_json(const CwDesign *design) {
  json_t *all = json_object();
  int failed = !all;
  for (int i = 0; i < CW_CORRELATED_COUNT; i++) {
    const int quantity = cw_correlated_quantity(i);
    char key[64] = "blade_count";
    double scale = 1, used = design->blade_count;
    if (quantity >= 0) {
      const CwDesignValue value = cw_hydraulic_design_value(design, quantity);
      snprintf(key, sizeof key, "%s", value.key);
      used = value.stored;
      scale = strstr(key, "_deg") ? 1 / CW_DEGREE : 1;
    }
    json_t *row = json_pack("{s:o}", "used", cw_json_number(used));
    for (int family = 0; family < CW_CORRELATION_FAMILIES; family++) {
      const char *source;
      const double correlated = cw_correlation(family, i, design, &source);
      failed |= json_object_set_new(
                    row, cw_case_choice("design", "correlations", family),
                    json_pack("{s:o, s:s}", "value", cw_json_number(correlated * scale), "source", source)) != 0;
    }
    failed |= json_object_set_new(all, key, row) != 0;
  }
  if (failed) {
    json_decref(all);
    return NULL;
  }
  return all;
}

static json_t *remarks_json(const CwDesign *design) {
  CwDesignRemarks remarks;
  json_t *list = json_array();
  cw_design_check(design, &remarks);
  for (int i = 0; i < remarks.count; i++) json_array_append_new(list, json_string(remarks.text[i]));
  return list;
}

// The spiral every 45 degrees behind its start.
static json_t *sections_json(const CwVolute *volute) {
  json_t *sections = json_array();
  for (int i = 1; sections && i <= 8; i++) {
    const CwVoluteSection s = cw_volute_section(volute, i * M_PI / 4);
    json_array_append_new(sections, json_pack("{s:f, s:f, s:f, s:f, s:f}", "angle_deg", 45.0 * i, "area_m2", s.area,
                                              "outer_radius_m", s.outer_radius, "side_wall_radius_m", s.kink_radius,
                                              "side_wall_width_m", 2 * s.kink_height));
  }
  return sections;
}

CwStatus cw_design_file_write(const CwDesign *design, const CwMeasuredPump *measured, const char *path) {
  CwStatus status = CW_OK;
  json_t *sources = json_pack("{s:s}", "blade_count", design->blade_count_source), *names = json_object();
  json_t *root = json_pack("{s:i, s:i, s:s, s:s, s:s, s:s, s:s, s:s}",                                           //
                           "blade_count", design->blade_count,                                                   //
                           "splitter_count", design->splitter_start > 0 ? design->blade_count : 0,               //
                           "priority", cw_case_choice("impeller", "priority", design->priority),                 //
                           "correlation_family", cw_case_choice("design", "correlations", design->correlations), //
                           "slip_model", cw_case_choice("design", "slip", design->slip),                         //
                           "rotation", cw_case_choice("impeller", "rotation", design->rotation),                 //
                           "blade_form", cw_case_choice("impeller", "blade_form", design->blade_form),           //
                           "trailing_edge", cw_case_choice("impeller", "trailing_edge", design->trailing_edge));
  int failed = 0;
  for (int i = 0; i < CW_DESIGN_COUNT; i++) {
    const CwDesignValue value = cw_hydraulic_design_value(design, i);
    failed |= json_object_set_new(root, value.key, cw_json_number(value.stored)) != 0;
    failed |= json_object_set_new(sources, value.key, json_string(design->source[i])) != 0;
    failed |= json_object_set_new(names, value.key, json_string(value.text)) != 0;
  }
  failed |= json_object_update_new(
                root, json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:O, s:O}",                            //
                                "rotor_volume_m3", cw_json_number(measured->solid[CW_PUMP_ROTOR].volume),   //
                                "stator_volume_m3", cw_json_number(measured->solid[CW_PUMP_STATOR].volume), //
                                "measured", cw_measured_json(measured),                                     //
                                "velocity_triangles", triangles_json(design),                               //
                                "correlations", correlations_json(design),                                  //
                                "remarks", remarks_json(design),                                            //
                                "volute_sections", sections_json(&design->volute),                          //
                                "sources", sources,                                                         //
                                "names", names)) != 0;
  CW_REQUIRE(!failed, CW_ERR_MEMORY, "%s: out of memory", path);
  CW_TRY(cw_json_write(root, path));
done:
  json_decref(root);
  json_decref(sources);
  json_decref(names);
  return status;
}
