// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_check.h"

#include <string.h>

#include "pipeline/case_points.h"

typedef enum { ABOVE, AT_LEAST, BELOW, AT_MOST } Relation;
static const char *const relation_texts[] = {"above", "at least", "below", "at most"};

// value(section.key) RELATION share * value(other), both in mm.
typedef struct {
  const char *section, *key;
  Relation relation;
  double share;
  const char *other_section, *other_key, *why;
} Rule;

static const Rule rules[] = {
    {"impeller", "inlet_diameter_mm", BELOW, 1, "impeller", "outlet_diameter_mm", "the flow goes outwards"},
    {"impeller", "outlet_width_mm", BELOW, 0.5, "impeller", "outlet_diameter_mm", "the impeller is radial"},
    {"impeller", "hub_diameter_mm", BELOW, 1, "impeller", "inlet_diameter_mm", "the eye must stay open"},
    {"impeller", "leading_edge_radius_hub_mm", BELOW, 0.5, "impeller", "outlet_diameter_mm",
     "the leading edge lies inside D2/2"},
    {"impeller", "leading_edge_radius_shroud_mm", BELOW, 0.5, "impeller", "outlet_diameter_mm",
     "the leading edge lies inside D2/2"},
    {"impeller", "leading_edge_radius_shroud_mm", ABOVE, 0.5, "impeller", "hub_diameter_mm",
     "the leading edge meets the shroud outside the hub"},
    {"impeller", "leading_edge_radius_hub_mm", AT_LEAST, 0.5, "impeller", "hub_diameter_mm",
     "the leading edge meets the hub outside its nut"},
    {"impeller", "leading_edge_thickness_mm", AT_MOST, 1, "impeller", "blade_thickness_mm",
     "this is the largest thickness of the blade"},
    {"impeller", "trailing_edge_thickness_mm", AT_MOST, 1, "impeller", "blade_thickness_mm",
     "this is the largest thickness of the blade"},
    {"impeller", "hub_nut_flat_diameter_mm", BELOW, 1, "impeller", "hub_diameter_mm",
     "the flat end is a part of the hub's nose"},
    {"impeller", "through_shaft_diameter_mm", AT_MOST, 1, "impeller", "hub_diameter_mm",
     "the shaft goes on from the hub"},
    {"impeller", "through_shaft_diameter_mm", BELOW, 1, "impeller", "inlet_diameter_mm", "the eye must stay open"},
    {"volute", "base_diameter_mm", ABOVE, 1, "impeller", "outlet_diameter_mm", "the volute lies around the impeller"},
    {"volute", "inlet_width_mm", AT_LEAST, 1, "impeller", "outlet_width_mm", "the volute takes the impeller's outlet"},
    {"walls", "total_thickness_mm", BELOW, 0.5, "impeller", "outlet_width_mm", "layers on hub and shroud would meet"},
    {"walls", "total_thickness_hub_shroud_mm", BELOW, 0.5, "impeller", "outlet_width_mm",
     "layers on hub and shroud would meet"},
};

static CwStatus check_rule(const char *path, const CwCase *table, const CwCasePlace *places, const Rule *rule) {
  CwStatus status = CW_OK;
  int left = cw_case_key_find(rule->section, rule->key);
  int right = cw_case_key_find(rule->other_section, rule->other_key);
  double value = cw_case_key_value(&cw_case_keys[left], table);
  double limit = rule->share * cw_case_key_value(&cw_case_keys[right], table);
  if (isnan(value) || isnan(limit)) goto done;
  // 37 mm is not exactly half of 74 mm once both went through metres.
  double slack = 1e-9 * fabs(limit);
  int fine = rule->relation == ABOVE      ? value > limit + slack
             : rule->relation == AT_LEAST ? value >= limit - slack
             : rule->relation == BELOW    ? value < limit - slack
                                          : value <= limit + slack;
  char name[CW_KEY_PATH_SIZE], other[CW_KEY_PATH_SIZE];
  cw_case_key_path(&cw_case_keys[left], name);
  cw_case_key_path(&cw_case_keys[right], other);
  CW_REQUIRE(fine, CW_ERR_INPUT, "%s:%d:%d: %s: %.6g contradicts %s%s (%s); allowed: %s %.6g mm", path,
             places[left].line, places[left].column, name, value, rule->share == 1 ? "" : "half of ", other, rule->why,
             relation_texts[rule->relation], limit);
done:
  return status;
}

static CwStatus check_priority(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  const CwCasePlace *place = &places[cw_case_key_find("impeller", "priority")];
  CW_REQUIRE(table->impeller.priority != CW_PRIORITY_WRAP || cw_case_given(table->impeller.wrap_angle), CW_ERR_INPUT,
             "%s:%d:%d: impeller.priority: wrap needs the key wrap_angle_deg, which is missing; allowed: "
             "wrap_angle_deg from 20 to 300 degrees, or priority auto, head or beta",
             path, place->line, place->column);
  CW_REQUIRE(table->impeller.priority != CW_PRIORITY_BETA || cw_case_given(table->impeller.outlet_blade_angle),
             CW_ERR_INPUT,
             "%s:%d:%d: impeller.priority: beta needs the key outlet_blade_angle_deg, which is missing; allowed: "
             "outlet_blade_angle_deg from 5 to 85 degrees, or priority auto, wrap or head",
             path, place->line, place->column);
done:
  return status;
}

static CwStatus check_operating_point(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  const CwCasePlace *place = &places[cw_case_key_find("operating_point", "speed_rpm")];
  const CwOperatingPoint *point = &table->operating_point;
  double rpm = point->speed * 30 / M_PI;
  // Specific speed nq = n sqrt(Q) / H^(3/4) in rpm, m3/s, m: radial and mixed-flow impellers lie in 5 to 160. Given by
  // their duty alone, those of 7 to 90 can be built.
  const double rpm_of_one = pow(point->head, 0.75) / sqrt(point->flow_rate), specific_speed = rpm / rpm_of_one;
  const double built = specific_speed < 5 ? 7 : 90;
  CW_REQUIRE(specific_speed >= 5 && specific_speed <= 160, CW_ERR_INPUT,
             "%s:%d:%d: operating_point.speed_rpm: %.6g contradicts flow rate and head, together they give the "
             "specific speed nq = %.4g; allowed: nq from 5 to 160 (of n in rpm, Q in m3/s, H in m), such as "
             "speed_rpm: %.6g with nq = %.0f",
             path, place->line, place->column, rpm, specific_speed, built * rpm_of_one, built);
  // Without swirl before the impeller no blade gives more than u2^2 / g (Euler).
  double tip_speed = point->speed * table->impeller.outlet_diameter / 2;
  double most = cw_case_given(tip_speed) ? tip_speed * tip_speed / CW_GRAVITY : INFINITY;
  place = &places[cw_case_key_find("operating_point", "head_m")];
  CW_REQUIRE(point->head < most, CW_ERR_INPUT,
             "%s:%d:%d: operating_point.head_m: %.6g contradicts speed_rpm and impeller.outlet_diameter_mm, which give "
             "the tip speed %.4g m/s; allowed: below %.4g m (u2^2/g)",
             path, place->line, place->column, point->head, tip_speed, most);
done:
  return status;
}

static CwStatus check_operating_points(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  const int shares = cw_case_key_find("operating_points", "flow_shares");
  const int rates = cw_case_key_find("operating_points", "flow_rates_m3_per_h");
  CW_REQUIRE(!places[shares].given || !places[rates].given, CW_ERR_INPUT,
             "%s:%d:%d: operating_points.flow_rates_m3_per_h: contradicts operating_points.flow_shares; allowed: one "
             "of them",
             path, places[rates].line, places[rates].column);
  CwCasePoint points[CW_LIST_MOST];
  const int count = cw_case_points(table, points);
  const CwCasePlace *place = &places[places[rates].given ? rates : shares];
  const double apart = 0.001 * (1 - 1e-9); // of the operating point's flow rate, but for rounding
  for (int k = 1; k < count; ++k)
    CW_REQUIRE(points[k].share >= points[k - 1].share + apart, CW_ERR_INPUT,
               "%s:%d:%d: operating_points.%s: value %d is not above the one before it by a thousandth of the "
               "operating point's flow rate; allowed: ascending values",
               path, place->line, place->column, places[rates].given ? "flow_rates_m3_per_h" : "flow_shares", k + 1);
  for (int k = 0; k < count; ++k)
    CW_REQUIRE(points[k].share >= 0.001 && points[k].share < 10, CW_ERR_INPUT,
               "%s:%d:%d: operating_points.flow_rates_m3_per_h: value %d is %.3g times the operating point's flow "
               "rate; allowed: 0.001 to 10 times",
               path, place->line, place->column, k + 1, points[k].share);
done:
  return status;
}

static CwStatus check_blockage(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  const CwImpellerTable *impeller = &table->impeller;
  const CwCasePlace *place = &places[cw_case_key_find("impeller", "blade_thickness_mm")];
  if (!cw_case_given(impeller->blade_thickness * impeller->inlet_diameter) || !impeller->blade_count) goto done;
  double most = 0.5 * M_PI * impeller->inlet_diameter / impeller->blade_count;
  CW_REQUIRE(impeller->blade_thickness < most, CW_ERR_INPUT,
             "%s:%d:%d: impeller.blade_thickness_mm: %.6g contradicts blade_count and inlet_diameter_mm (the blades "
             "fill the inlet); allowed: below %.4g mm",
             path, place->line, place->column, 1000 * impeller->blade_thickness, 1000 * most);
done:
  return status;
}

static CwStatus check_roughness(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  const CwCasePlace *place = &places[cw_case_key_find("walls", "treatment")];
  CW_REQUIRE(table->walls.treatment != CW_WALL_FUNCTION_ROUGH || table->walls.roughness > 0, CW_ERR_INPUT,
             "%s:%d:%d: walls.treatment: rough contradicts roughness_um, which is 0; allowed: smooth, or roughness_um "
             "above 0 to 5000 um",
             path, place->line, place->column);
done:
  return status;
}

// Pairs of keys of which each follows from the other.
static CwStatus check_volute(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  static const char *const pairs[][2] = {{"tongue_angle_deg", "tongue_gap_mm"},
                                         {"diffuser_angle_deg", "diffuser_length_mm"},
                                         {"diffuser_area_ratio", "outlet_diameter_mm"}};
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
    const int key = cw_case_key_find("volute", pairs[i][0]), other = cw_case_key_find("volute", pairs[i][1]);
    const double value = cw_case_key_value(&cw_case_keys[key], table);
    CW_REQUIRE(isnan(value) || isnan(cw_case_key_value(&cw_case_keys[other], table)), CW_ERR_INPUT,
               "%s:%d:%d: volute.%s: %.6g contradicts volute.%s, from which it follows; allowed: one of them", path,
               places[key].line, places[key].column, pairs[i][0], value, pairs[i][1]);
  }
  const CwCasePlace *place = &places[cw_case_key_find("volute", "velocity_factor")];
  CW_REQUIRE(isnan(table->volute.velocity_factor) || table->volute.area_law == CW_AREA_LAW_VELOCITY, CW_ERR_INPUT,
             "%s:%d:%d: volute.velocity_factor: %.6g is of no use with the area_law angular_momentum; "
             "allowed: with area_law velocity",
             path, place->line, place->column, table->volute.velocity_factor);
  place = &places[cw_case_key_find("volute", "corner_radius_mm")];
  CW_REQUIRE(isnan(table->volute.corner_radius) || table->volute.section != CW_SECTION_CIRCLE, CW_ERR_INPUT,
             "%s:%d:%d: volute.corner_radius_mm: %.6g is of no use with the section circle; allowed: with "
             "section trapezoid or rectangle",
             path, place->line, place->column, 1000 * table->volute.corner_radius);
done:
  return status;
}

// The hydraulic design has no part in a pump from CAD files.
static CwStatus check_cad(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  static const char *const sections[] = {"design", "impeller", "volute"};
  for (size_t i = 0; table->cad && i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    int of_design = 0;
    for (size_t k = 0; k < sizeof sections / sizeof *sections; ++k) of_design |= !strcmp(key->section, sections[k]);
    CW_REQUIRE(!of_design || !places[i].given, CW_ERR_INPUT,
               "%s:%d:%d: %s.%s: contradicts the section cad, whose solids come from files; allowed: one of both", path,
               places[i].line, places[i].column, key->section, key->key);
  }
done:
  return status;
}

// They read pump.cgns by the standard.
static CwStatus check_profile(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  const CwCasePlace *place = &places[cw_case_key_find("cgns", "profile")];
  const int formats = table->output.formats, has_cfx = formats >> CW_FORMAT_CFX & 1;
  CW_REQUIRE(table->output.cgns_profile == CW_CGNS_STRICT || !(has_cfx || formats >> CW_FORMAT_SATURNE & 1),
             CW_ERR_INPUT,
             "%s:%d:%d: cgns.profile: vendor contradicts export.formats, whose %s reads pump.cgns in the standard's "
             "order; allowed: strict, or formats without cfx and code_saturne ([cgns, openfoam])",
             path, place->line, place->column, has_cfx ? "cfx" : "code_saturne");
done:
  return status;
}

CwStatus cw_case_check(const char *path, const CwCase *table, const CwCasePlace *places) {
  CwStatus status = CW_OK;
  CW_TRY(check_cad(path, table, places));
  CW_TRY(check_priority(path, table, places));
  for (size_t i = 0; i < sizeof rules / sizeof *rules; ++i) CW_TRY(check_rule(path, table, places, &rules[i]));
  CW_TRY(check_operating_point(path, table, places));
  CW_TRY(check_operating_points(path, table, places));
  CW_TRY(check_blockage(path, table, places));
  CW_TRY(check_roughness(path, table, places));
  CW_TRY(check_volute(path, table, places));
  CW_TRY(check_profile(path, table, places));
done:
  return status;
}

// A mesh has some cells more or fewer than it is asked for.
CwStatus cw_case_check_parts(const char *path, const CwCase *table) {
  CwStatus status = CW_OK;
  const int parts = table->output.foam_processors;
  const long long cells = table->mesh.cells;
  CW_REQUIRE(
      !(table->output.formats >> CW_FORMAT_OPENFOAM & 1) || parts <= cells / 2, CW_ERR_INPUT,
      "%s: openfoam.processors: %d parts of %lld cells (mesh.cells, or --cells); allowed: 1 to %lld, two cells a "
      "part",
      path, parts, cells, cells / 2);
done:
  return status;
}
