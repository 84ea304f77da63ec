// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_schema.h"

#include <string.h>

#include "pipeline/water.h"

static const char *const priorities[] = {"wrap", "head", "beta", "auto", NULL};
static const char *const correlation_families[] = {"guelich", "guan", NULL};
static const char *const slip_models[] = {"wiesner", "pfleiderer", NULL};
static const char *const blade_forms[] = {"twisted", "cylindrical", NULL};
static const char *const trailing_edges[] = {"bevelled", "blunt", "rounded", "sharp", NULL};
static const char *const rotations[] = {"counter_clockwise", "clockwise", NULL};
static const char *const area_laws[] = {"angular_momentum", "velocity", NULL};
static const char *const sections[] = {"trapezoid", "rectangle", "circle", NULL};
static const char *const discharges[] = {"tangential", "radial", NULL};
static const char *const suction_zones[] = {"rotor", "own", NULL};
static const char *const discharge_zones[] = {"stator", "own", NULL};
static const char *const y_plus_places[] = {"node", "cell_centre", NULL};
static const char *const truths[] = {"false", "true", NULL};
static const char *const fills[] = {"kernel", "tetgen", NULL};
static const char *const sweeps[] = {"layers_stay", "similar", NULL};
static const char *const formats[] = {"cgns", "openfoam", "cfx", "fluent", "code_saturne", NULL};
static const char *const foam_releases[] = {"v1912", "v2406", NULL};
static const char *const integers[] = {"auto", "32", "64", NULL};
static const char *const cgns_profiles[] = {"strict", "vendor", NULL};
static const char *const treatments[] = {"smooth", "rough", NULL};

#define AT(field) offsetof(CwCase, field)
#define REAL_REQUIRED(section, key, unit, least, most, field, meaning)                                                 \
  { section, key, CW_KEY_REAL, CW_KEY_REQUIRED, unit, least, most, NAN, NULL, AT(field), meaning }
#define REAL_DEFAULT(section, key, unit, least, most, fallback, field, meaning)                                        \
  { section, key, CW_KEY_REAL, CW_KEY_DEFAULT, unit, least, most, fallback, NULL, AT(field), meaning }
#define REAL_COMPUTED(section, key, unit, least, most, field, meaning)                                                 \
  { section, key, CW_KEY_REAL, CW_KEY_COMPUTED, unit, least, most, NAN, NULL, AT(field), meaning }
#define REAL_OPTIONAL(section, key, unit, least, most, field, meaning)                                                 \
  { section, key, CW_KEY_REAL, CW_KEY_OPTIONAL, unit, least, most, NAN, NULL, AT(field), meaning }
#define REAL_AUTO(section, key, unit, least, most, field, meaning)                                                     \
  { section, key, CW_KEY_REAL, CW_KEY_AUTO, unit, least, most, NAN, NULL, AT(field), meaning }
#define LIST(section, key, unit, least, most, field, meaning)                                                          \
  { section, key, CW_KEY_LIST, CW_KEY_COMPUTED, unit, least, most, NAN, NULL, AT(field), meaning }
#define CHOICES(section, key, choices, fallback, field, meaning)                                                       \
  { section, key, CW_KEY_CHOICES, CW_KEY_DEFAULT, "", 0, 0, fallback, choices, AT(field), meaning }
#define CHOICE(section, key, choices, fallback, field, meaning)                                                        \
  { section, key, CW_KEY_CHOICE, CW_KEY_DEFAULT, "", 0, 0, fallback, choices, AT(field), meaning }

// The layers of one group of walls.
#define WALL_GROUP(suffix, group, place)                                                                               \
  REAL_AUTO("walls", "y_plus_" suffix, "", 0.05, 1000, walls.group.y_plus,                                             \
            "target " place                                                                                            \
            "; auto: the least of other walls; where all are open 30, more where cells are large, less where it is "   \
            "narrow"),                                                                                                 \
      REAL_COMPUTED("walls", "velocity_" suffix "_m_per_s", "m_per_s", 0.001, 1000, walls.group.velocity,              \
                    "of the flow along the walls " place "; computed: by the design"),                                 \
      REAL_COMPUTED("walls", "first_height_" suffix "_um", "um", 0.01, 1e5, walls.group.first_height,                  \
                    "of the first layer " place "; computed: from y+ and velocity"),                                   \
      REAL_COMPUTED("walls", "growth_ratio_" suffix, "", 1, 2, walls.group.growth_ratio,                               \
                    "largest growth ratio " place "; computed: growth_ratio"),                                         \
      REAL_COMPUTED("walls", "total_thickness_" suffix "_mm", "mm", 0.001, 200, walls.group.total_thickness,           \
                    "of all layers together " place "; computed: total_thickness, or as that one is")

const CwCaseKey cw_case_keys[] = {
    {"", "name", CW_KEY_NAME, CW_KEY_REQUIRED, "", 1, CW_NAME_SIZE - 1, 0, NULL, AT(name),
     "name of the case, used for the run's folder and as a name in the exported files"},

    REAL_REQUIRED("operating_point", "flow_rate_m3_per_h", "m3_per_h", 0.001, 1000000, operating_point.flow_rate,
                  "Q, delivered"),
    REAL_REQUIRED("operating_point", "head_m", "m", 0.01, 5000, operating_point.head, "H, design head"),
    REAL_REQUIRED("operating_point", "speed_rpm", "rpm", 10, 100000, operating_point.speed,
                  "n, about +z by the right hand"),
    REAL_DEFAULT("operating_point", "inlet_pressure_pa", "pa", 100, 1e8, 101325, operating_point.inlet_pressure,
                 "absolute total pressure at the inlet"),
    REAL_DEFAULT("operating_point", "time_step_deg", "deg", 0.01, 20, 1, operating_point.time_step_angle,
                 "rotation in one time step of the transient run"),
    REAL_OPTIONAL("operating_point", "test_head_m", "m", 0.01, 5000, operating_point.test_head,
                  "head that was measured here, to be drawn beside the solved ones"),

    LIST(
        "operating_points", "flow_shares", "", 0.01, 3, operating_points.flow_shares,
        "points of the characteristic curve, as shares of the operating point's flow rate; computed: 0.6, 0.8, 1, 1.2"),
    LIST("operating_points", "flow_rates_m3_per_h", "m3_per_h", 0.00001, 3000000, operating_points.flow_rates,
         "the same as flow rates, instead of flow_shares; computed: from flow_shares"),

    REAL_DEFAULT("fluid", "density_kg_per_m3", "kg_per_m3", 0.1, 20000, 998.2, fluid.density,
                 "density; the default is water at 20 degrees Celsius"),
    REAL_DEFAULT("fluid", "kinematic_viscosity_m2_per_s", "m2_per_s", 1e-8, 1e-2, 1.004e-6, fluid.kinematic_viscosity,
                 "kinematic viscosity; the default is water at 20 degrees Celsius"),
    REAL_OPTIONAL("fluid", "temperature_c", "c", CW_WATER_COLDEST, CW_WATER_HOTTEST, fluid.temperature,
                  "of water: sets density, viscosity and vapour pressure where they are left out (IAPWS)"),
    REAL_COMPUTED(
        "fluid", "vapour_pressure_pa", "pa", 0, 3e7, fluid.vapour_pressure,
        "absolute, for the NPSH at the inlet; computed: of water at temperature_c, else at 20 degrees Celsius"),

    CHOICE("design", "correlations", correlation_families, CW_CORRELATIONS_GUELICH, design.correlations,
           "whose correlations give what the table leaves open: those of Guelich or of Guan (docs/geometry.md)"),
    CHOICE("design", "slip", slip_models, CW_SLIP_WIESNER, design.slip, "slip model of the predicted head"),
    REAL_DEFAULT("design", "warn_share", "", 0.01, 1, 0.1, design.warn_share,
                 "a given value that differs from the correlations by more than this share is warned of"),

    CHOICE("impeller", "priority", priorities, CW_PRIORITY_AUTO, impeller.priority,
           "the law of an over-determined table: the wrap angle, the head, or the blade angle at the outlet; "
           "auto: wrap where it is given, else beta where it is given, else head"),
    CHOICE("impeller", "rotation", rotations, CW_ROTATION_COUNTER_CLOCKWISE, impeller.rotation,
           "seen from the drive; the wheel turns about +z either way, and clockwise has its suction at +z"),
    {"impeller", "blade_count", CW_KEY_INT, CW_KEY_COMPUTED, "", 2, 12, 0, NULL, AT(impeller.blade_count),
     "z, number of blades without splitters"},
    REAL_COMPUTED("impeller", "inlet_diameter_mm", "mm", 1, 10000, impeller.inlet_diameter, "D1, of the eye"),
    REAL_COMPUTED("impeller", "outlet_diameter_mm", "mm", 10, 10000, impeller.outlet_diameter,
                  "D2, of the blades' trailing edges"),
    REAL_COMPUTED("impeller", "outlet_width_mm", "mm", 0.05, 2000, impeller.outlet_width,
                  "b2, between hub and shroud at D2"),
    REAL_COMPUTED("impeller", "wrap_angle_deg", "deg", 20, 300, impeller.wrap_angle,
                  "angle about the axis from leading to trailing edge; required where it is the priority"),
    REAL_COMPUTED("impeller", "wrap_spread_deg", "deg", -90, 90, impeller.wrap_spread,
                  "wrap at the shroud minus wrap at the hub; wrap_angle_deg holds at mid-span"),
    REAL_COMPUTED("impeller", "hub_diameter_mm", "mm", 0.1, 10000, impeller.hub_diameter, "of the hub at its nut"),
    REAL_COMPUTED("impeller", "hub_nut_length_mm", "mm", 0.01, 10000, impeller.nut_length,
                  "of the hub's elliptic nose"),
    REAL_COMPUTED("impeller", "hub_nut_flat_diameter_mm", "mm", 0.01, 10000, impeller.nut_flat_diameter,
                  "of the flat end of the hub's nose"),
    REAL_DEFAULT("impeller", "through_shaft_diameter_mm", "mm", 0, 10000, 0, impeller.through_shaft_diameter,
                 "of a shaft that goes on from the hub out through the inlet, which becomes a ring; 0: none"),
    REAL_DEFAULT("impeller", "root_fillet_radius_mm", "mm", 0, 200, 0, impeller.root_fillet_radius,
                 "of the fillets between blades and hub and shroud; 0: none"),
    REAL_COMPUTED("impeller", "axial_length_mm", "mm", 0.05, 10000, impeller.axial_length,
                  "of the shroud, from the eye to its end at D2"),
    REAL_COMPUTED("impeller", "hub_pole_radial", "", 0.2, 3, impeller.hub_pole_radial,
                  "third Bezier pole of the hub, outside the hub's radius, as a share of the eye's height"),
    REAL_COMPUTED("impeller", "shroud_pole_axial", "", 0.02, 0.95, impeller.shroud_pole_axial,
                  "second Bezier pole of the shroud, before the shroud's end, as a share of the axial length"),
    REAL_COMPUTED("impeller", "shroud_pole_radial", "", 0, 0.8, impeller.shroud_pole_radial,
                  "third Bezier pole of the shroud, outside the eye, as a share of (D2 - D1) / 2"),
    REAL_COMPUTED("impeller", "leading_edge_radius_hub_mm", "mm", 0.1, 5000, impeller.leading_edge_radius_hub,
                  "radius where the leading edge meets the hub"),
    REAL_COMPUTED("impeller", "leading_edge_radius_shroud_mm", "mm", 0.1, 5000, impeller.leading_edge_radius_shroud,
                  "radius where the leading edge meets the shroud"),
    REAL_COMPUTED("impeller", "incidence_deg", "deg", -10, 20, impeller.incidence,
                  "beta1 minus the flow angle, where beta1 is computed"),
    REAL_COMPUTED("impeller", "inlet_blade_angle_deg", "deg", 5, 85, impeller.inlet_blade_angle,
                  "beta1 at mid-span, from the tangential direction"),
    REAL_COMPUTED("impeller", "outlet_blade_angle_deg", "deg", 5, 85, impeller.outlet_blade_angle,
                  "beta2, from the tangential direction; required where it is the priority"),
    REAL_COMPUTED("impeller", "leading_edge_thickness_mm", "mm", 0.01, 500, impeller.leading_edge_thickness,
                  "blade thickness behind the rounding of the leading edge"),
    REAL_COMPUTED("impeller", "blade_thickness_mm", "mm", 0.01, 500, impeller.blade_thickness,
                  "largest blade thickness"),
    REAL_COMPUTED("impeller", "trailing_edge_thickness_mm", "mm", 0.01, 500, impeller.trailing_edge_thickness,
                  "blade thickness at the blunt trailing edge"),
    REAL_COMPUTED("impeller", "trailing_edge_bevel_mm", "mm", 0.001, 500, impeller.trailing_edge_bevel,
                  "length of the facet that takes off the acute corner of the trailing edge"),
    CHOICE("impeller", "trailing_edge", trailing_edges, CW_EDGE_BEVELLED, impeller.trailing_edge,
           "blunt: cut on D2; bevelled: blunt with the acute corner taken off; rounded: a half circle; sharp: the "
           "facet takes all of the cut"),
    REAL_DEFAULT("impeller", "leading_edge_ratio", "", 1, 6, 2, impeller.leading_edge_ratio,
                 "semi-axes of the leading edge's ellipse, along to across the blade"),
    REAL_DEFAULT("impeller", "thickest_at", "", 0.2, 0.8, 0.45, impeller.thickest_at,
                 "share of the blade's length where it is thickest"),
    CHOICE("impeller", "blade_form", blade_forms, CW_BLADE_TWISTED, impeller.blade_form,
           "twisted: every section has its own angles; cylindrical: straight parallel to the axis"),
    REAL_DEFAULT("impeller", "lean_deg", "deg", -30, 30, 0, impeller.lean_angle,
                 "of the trailing edge from the axial direction; positive: the shroud's end ahead"),
    REAL_OPTIONAL("impeller", "splitter_start", "", 0.15, 0.8, impeller.splitter_start,
                  "share of the meridional length where z splitter blades begin"),
    REAL_DEFAULT("impeller", "splitter_position", "", 0.3, 0.7, 0.5, impeller.splitter_position,
                 "share of the pitch from a blade's pressure side to the next splitter"),
    REAL_COMPUTED("impeller", "suction_pipe_length_mm", "mm", 0.1, 1000000, impeller.suction_pipe_length,
                  "straight pipe before the shroud's inlet"),
    CHOICE("impeller", "suction_pipe_zone", suction_zones, CW_PIPE_WITH_NEIGHBOUR, impeller.suction_pipe_zone,
           "own: the suction pipe is a stationary zone, coupled at a disc D1/4 before the hub's nut"),

    REAL_COMPUTED("volute", "base_diameter_mm", "mm", 2, 12000, volute.base_diameter, "D3, base circle of the spiral"),
    REAL_COMPUTED("volute", "inlet_width_mm", "mm", 0.05, 5000, volute.inlet_width, "b3, width at D3"),
    CHOICE("volute", "area_law", area_laws, CW_AREA_LAW_ANGULAR_MOMENTUM, volute.area_law,
           "how the sections grow: by constant angular momentum c_u r, or by constant velocity (Stepanoff)"),
    REAL_COMPUTED("volute", "velocity_factor", "", 0.1, 1, volute.velocity_factor,
                  "K3 = c3 / sqrt(2 g H), of the law of constant velocity"),
    CHOICE("volute", "section", sections, CW_SECTION_TRAPEZOID, volute.section,
           "shape of the sections: trapezoid, rectangle with parallel side walls, or a circle that touches "
           "the side walls"),
    REAL_COMPUTED("volute", "side_wall_angle_deg", "deg", 1, 45, volute.side_wall_angle,
                  "half angle between the side walls: side wall from the plane normal to the axis; not used "
                  "by a rectangle"),
    REAL_COMPUTED("volute", "corner_radius_mm", "mm", 0.01, 2000, volute.corner_radius,
                  "between side walls and outer wall; a trapezoid without it has one flat arc as outer wall, "
                  "a circle has none"),
    REAL_COMPUTED("volute", "tongue_radius_mm", "mm", 0.01, 500, volute.tongue_radius, "of the tongue's nose"),
    REAL_COMPUTED("volute", "tongue_gap_mm", "mm", 0.005, 2000, volute.tongue_gap,
                  "radial distance from the base circle to the tongue's tip"),
    REAL_COMPUTED("volute", "tongue_angle_deg", "deg", 5, 80, volute.tongue_angle,
                  "from the start of the spiral to the tongue's tip; instead of the gap"),
    REAL_COMPUTED("volute", "throat_area_mm2", "mm2", 0.1, 100000000, volute.throat_area,
                  "section of the volute at the tongue"),
    REAL_COMPUTED("volute", "diffuser_length_mm", "mm", 0.1, 100000, volute.diffuser_length,
                  "from the throat to the outlet diameter"),
    REAL_COMPUTED("volute", "diffuser_angle_deg", "deg", 1, 30, volute.diffuser_angle,
                  "full angle of the cone of equal areas; instead of the length"),
    REAL_COMPUTED("volute", "diffuser_area_ratio", "", 1.05, 4, volute.diffuser_area_ratio,
                  "area of the outlet over that of the throat; instead of the outlet diameter"),
    CHOICE("volute", "discharge", discharges, CW_DISCHARGE_TANGENTIAL, volute.discharge,
           "tangential: straight on from the throat; radial: bent until the pipe points away from the axis"),
    REAL_COMPUTED("volute", "outlet_diameter_mm", "mm", 0.5, 10000, volute.outlet_diameter, "DN, of the discharge"),
    REAL_COMPUTED("volute", "discharge_pipe_length_mm", "mm", 0.1, 1000000, volute.discharge_pipe_length,
                  "straight pipe behind the diffuser"),
    CHOICE("volute", "discharge_pipe_zone", discharge_zones, CW_PIPE_WITH_NEIGHBOUR, volute.discharge_pipe_zone,
           "own: the discharge pipe is a zone, coupled at a disc DN/4 behind the diffuser"),

    REAL_DEFAULT("walls", "roughness_um", "um", 0, 5000, 0, walls.roughness,
                 "equivalent sand grain roughness of all walls"),
    CHOICE("walls", "treatment", treatments, CW_WALL_FUNCTION_SMOOTH, walls.treatment,
           "wall function: smooth, or rough with the roughness above"),
    CHOICE("walls", "y_plus_at", y_plus_places, CW_Y_PLUS_AT_CELL_CENTRE, walls.y_plus_at,
           "where y+ is asked: at the first node (CFX) or at the first cell centre (OpenFOAM)"),
    WALL_GROUP("blade", blade, "on the blades"),
    WALL_GROUP("hub_shroud", hub_shroud, "on hub and shroud"),
    WALL_GROUP("volute", volute, "in the volute, on the tongue and in the neck"),
    WALL_GROUP("pipe", pipe, "in the suction and discharge pipes and in the diffuser"),
    {"walls", "layer_count", CW_KEY_INT, CW_KEY_AUTO, "", 1, CW_LAYERS_MOST, 0, NULL, AT(walls.layer_count),
     "number of prism layers, on all walls; auto: as many as lead from the first height to the size of the "
     "tetrahedra, as far as mesh.cells has room for them; given or not, more than three go, and a headline tells of "
     "it, where they would leave edges so long that triangles on narrow faces have less than 20 degrees"},
    REAL_AUTO("walls", "growth_ratio", "", 1, 2, walls.growth_ratio,
              "largest ratio of the heights of neighbouring layers; auto: 1.3, columns take what they need of it"),
    REAL_COMPUTED("walls", "total_thickness_mm", "mm", 0.001, 200, walls.total_thickness,
                  "of all layers together; computed: from first height, count and growth ratio"),

    {"mesh", "cells", CW_KEY_INT64, CW_KEY_DEFAULT, "", 10000, 2e9, 1000000, NULL, AT(mesh.cells),
     "cells of all zones together; --cells on the command line goes before it"},
    CHOICE("mesh", "sweep", sweeps, CW_SWEEP_LAYERS_STAY, mesh.sweep,
           "what another number of cells (--cells) does to the layers: they stay, or become similar: more and thinner "
           "ones of the same whole thickness"),
    {"mesh", "cells_per_region", CW_KEY_INT64, CW_KEY_COMPUTED, "", 5000, 4e6, 0, NULL, AT(mesh.cells_per_region),
     "about this many cells a region; computed: 270,000, above 38 million a 140th of all, at most 2 million"},
    {"mesh", "least_regions", CW_KEY_INT, CW_KEY_DEFAULT, "", 1, 1000, 4, NULL, AT(mesh.least_regions),
     "least number of regions of a domain; beyond 4 no more than one for 5000 cells, and a warning says how many; with "
     "1 and few cells a domain is not divided"},
    CHOICE("mesh", "fill", fills, CW_FILL_KERNEL, mesh.fill,
           "what makes the tetrahedra: the project's own Delaunay kernel, with TetGen where it cannot, or TetGen "
           "alone"),
    CHOICE("mesh", "periodic_impeller", truths, 1, mesh.periodic_impeller,
           "true: one of the equal passages of the impeller is meshed and turned for the others; false: all at once"),
    REAL_DEFAULT("mesh", "gradation", "", 0.05, 1, 0.25, mesh.gradation,
                 "most growth of the cell size with distance: change of size per distance"),
    REAL_DEFAULT("mesh", "curvature_angle_deg", "deg", 2, 60, 20, mesh.curvature_angle,
                 "turn of the surface normal across one edge, at relative size 1"),
    REAL_DEFAULT("mesh", "cells_across_gap", "", 1, 20, 3, mesh.cells_across_gap,
                 "least number of cells across a narrow place"),
    REAL_DEFAULT("mesh", "size_blade", "", 0.05, 20, 0.6, mesh.size_blade,
                 "cell size on the blades, relative to the base size"),
    REAL_DEFAULT("mesh", "size_hub_shroud", "", 0.05, 20, 0.9, mesh.size_hub_shroud, "the same on hub and shroud"),
    REAL_DEFAULT("mesh", "size_volute", "", 0.05, 20, 0.9, mesh.size_volute, "the same in the volute"),
    REAL_DEFAULT("mesh", "size_pipe", "", 0.05, 20, 1.2, mesh.size_pipe, "the same in the pipes"),
    REAL_DEFAULT("mesh", "size_interface", "", 0.05, 20, 0.9, mesh.size_interface,
                 "the same on the interface between rotor and stator"),

    CHOICES("export", "formats", formats, 1 << CW_FORMAT_CGNS | 1 << CW_FORMAT_OPENFOAM | 1 << CW_FORMAT_CFX,
            output.formats, "what the mesh is written for; cfx and code_saturne read pump.cgns and bring it with them"),
    CHOICE("cgns", "integers", integers, CW_INTEGERS_AUTO, output.cgns_integers,
           "bits of the integers of pump.cgns; auto: 64 where a zone has 2^31 points or elements or more, else 32"),
    CHOICE("cgns", "profile", cgns_profiles, CW_CGNS_STRICT, output.cgns_profile,
           "corners of the prisms; strict: in the standard's order; vendor: in VTK's, whose reader takes them as they "
           "stand, not with cfx or code_saturne"),
    {"openfoam", "processors", CW_KEY_INT, CW_KEY_DEFAULT, "", 1, 100000, 1, NULL, AT(output.foam_processors),
     "above 1: the mesh is written divided into so many folders processorN, for as many ranks, instead of whole"},
    CHOICE("openfoam", "release", foam_releases, CW_FOAM_V1912, output.foam_release,
           "whose dictionaries; v2406 by its documentation, not run here"),
    CHOICE("openfoam", "labels", integers, CW_INTEGERS_AUTO, output.foam_labels,
           "bits of the labels; auto: 64 where a count of the mesh is 2^31 or more, else 32"),
};
const size_t cw_case_key_count = sizeof cw_case_keys / sizeof *cw_case_keys;
_Static_assert(sizeof cw_case_keys / sizeof *cw_case_keys <= CW_CASE_KEYS_MOST, "a case has no room for its keys");

int cw_case_key_find(const char *section, const char *key) {
  for (size_t i = 0; i < cw_case_key_count; ++i)
    if (!strcmp(cw_case_keys[i].section, section) && !strcmp(cw_case_keys[i].key, key)) return (int)i;
  return -1;
}

int cw_case_key_find_in(const char *section, const char *key, const CwUnit **unit) {
  size_t stem, key_stem;
  int index = cw_case_key_find(section, key);
  *unit = index < 0 ? cw_unit_of_key(key, &stem) : cw_unit_find(cw_case_keys[index].unit);
  for (size_t i = 0; index < 0 && *unit && i < cw_case_key_count; ++i) {
    const CwUnit *own = cw_unit_find(cw_case_keys[i].unit);
    if (!own || strcmp(own->quantity, (*unit)->quantity) || strcmp(cw_case_keys[i].section, section)) continue;
    cw_unit_of_key(cw_case_keys[i].key, &key_stem);
    // The unit itself must be written as in the table: "head_FT" is taken for a slip.
    if (stem == key_stem && !strncmp(key, cw_case_keys[i].key, stem) && !strcmp(key + stem + 1, (*unit)->suffix))
      index = (int)i;
  }
  return index;
}

int cw_case_section_known(const char *section) {
  for (size_t i = 0; i < cw_case_key_count; ++i)
    if (!strcmp(cw_case_keys[i].section, section)) return 1;
  return 0;
}

int cw_case_key_shapes_pump(const CwCaseKey *key) {
  static const char *const others[] = {"walls", "mesh", "operating_points", "export", "cgns", "openfoam"};
  for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
    if (!strcmp(key->section, others[i])) return 0;
  return key->offset != AT(operating_point.time_step_angle) && key->offset != AT(operating_point.test_head);
}

void cw_case_key_path(const CwCaseKey *key, char path[CW_KEY_PATH_SIZE]) {
  snprintf(path, CW_KEY_PATH_SIZE, "%s%s%s", key->section, key->section[0] ? "." : "", key->key);
}

static const char *unit_text(const CwCaseKey *key) {
  const CwUnit *unit = cw_unit_find(key->unit);
  return unit ? unit->text : "";
}

void cw_case_words(const char *const *words, char *text, size_t size) {
  size_t used = 0;
  if (size > 0) text[0] = '\0';
  for (int i = 0; words[i] && used < size; ++i) {
    const char *between = i == 0 ? "" : words[i + 1] ? ", " : " or ";
    used += (size_t)snprintf(text + used, size - used, "%s%s", between, words[i]);
  }
}

void cw_case_key_allowed(const CwCaseKey *key, char allowed[CW_KEY_ALLOWED_SIZE]) {
  size_t size = CW_KEY_ALLOWED_SIZE, used = 0;
  const char *or_auto = key->presence == CW_KEY_AUTO ? ", or auto" : "";
  switch (key->type) {
  case CW_KEY_REAL:
    snprintf(allowed, size, "%.10g to %.10g%s%s%s", key->least, key->most, key->unit[0] ? " " : "", unit_text(key),
             or_auto);
    return;
  case CW_KEY_INT:
    snprintf(allowed, size, "a whole number from %.0f to %.0f%s", key->least, key->most, or_auto);
    return;
  case CW_KEY_INT64:
    snprintf(allowed, size, "a whole number from %.0f to %.0f, as 500000, 500k or 2M", key->least, key->most);
    return;
  case CW_KEY_CHOICE:
  case CW_KEY_CHOICES:
    used = (size_t)snprintf(allowed, size, "%s", key->type == CW_KEY_CHOICES ? "a list of one or more of " : "");
    cw_case_words(key->choices, allowed + used, size - used);
    return;
  case CW_KEY_NAME:
    snprintf(allowed, size, "%.0f to %.0f letters, digits, _ and -, a letter first", key->least, key->most);
    return;
  case CW_KEY_LIST:
    snprintf(allowed, size, "a list [..., ...] of 1 to %d ascending values, each %.10g to %.10g%s%s", CW_LIST_MOST,
             key->least, key->most, key->unit[0] ? " " : "", unit_text(key));
    return;
  }
}

const char *cw_case_choice(const char *section, const char *key, int value) {
  return cw_case_keys[cw_case_key_find(section, key)].choices[value];
}

void cw_case_key_chosen(const CwCaseKey *key, double value, char text[CW_KEY_ALLOWED_SIZE]) {
  size_t used = 0, size = CW_KEY_ALLOWED_SIZE;
  if (key->type == CW_KEY_CHOICE) {
    snprintf(text, size, "%s", key->choices[(int)value]);
    return;
  }
  for (int i = 0; key->choices[i] && used < size; ++i)
    if ((int)value & 1 << i)
      used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "[", key->choices[i]);
  if (used < size) snprintf(text + used, size - used, "%s", used ? "]" : "[]");
}

double cw_case_key_value(const CwCaseKey *key, const CwCase *table) {
  const char *field = (const char *)table + key->offset;
  const CwUnit *unit = cw_unit_find(key->unit);
  double real;
  int integer;
  int64_t large;
  switch (key->type) {
  case CW_KEY_REAL:
    memcpy(&real, field, sizeof real);
    return unit ? real * unit->denominator / unit->numerator : real;
  case CW_KEY_INT:
  case CW_KEY_CHOICE:
  case CW_KEY_CHOICES:
    memcpy(&integer, field, sizeof integer);
    return integer;
  case CW_KEY_INT64:
    memcpy(&large, field, sizeof large);
    return (double)large;
  case CW_KEY_NAME:
  case CW_KEY_LIST:
    break;
  }
  return NAN;
}

_Static_assert(sizeof(CwPriority) == sizeof(int), "a choice is stored as an int");

void cw_case_key_set(const CwCaseKey *key, double value, CwCase *table) {
  cw_case_key_set_in(key, cw_unit_find(key->unit), value, table);
}

void cw_case_key_set_in(const CwCaseKey *key, const CwUnit *unit, double value, CwCase *table) {
  char *field = (char *)table + key->offset;
  double real = unit ? value * unit->numerator / unit->denominator : value;
  int integer;
  int64_t large;
  CwList *list;
  switch (key->type) {
  case CW_KEY_REAL:
    memcpy(field, &real, sizeof real);
    return;
  case CW_KEY_LIST:
    list = (CwList *)(void *)field;
    if (list->count < CW_LIST_MOST) list->value[list->count++] = real;
    return;
  case CW_KEY_INT:
  case CW_KEY_CHOICE:
  case CW_KEY_CHOICES:
    integer = (int)value;
    memcpy(field, &integer, sizeof integer);
    return;
  case CW_KEY_INT64:
    large = (int64_t)value;
    memcpy(field, &large, sizeof large);
    return;
  case CW_KEY_NAME:
    return;
  }
}

void cw_case_defaults(CwCase *table) {
  memset(table, 0, sizeof *table);
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    if (key->type != CW_KEY_NAME && key->type != CW_KEY_LIST &&
        (key->presence != CW_KEY_REQUIRED || key->type == CW_KEY_REAL))
      cw_case_key_set(key, key->fallback, table);
  }
}

void cw_case_schema_markdown(FILE *stream) {
  const char *section = NULL;
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    if (!section || strcmp(section, key->section)) {
      section = key->section;
      if (i) fputc('\n', stream);
      fprintf(stream, section[0] ? "### %s\n\n" : "### Top of the file\n\n", section);
      fputs("| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n", stream);
    }
    char allowed[CW_KEY_ALLOWED_SIZE], fallback[CW_KEY_ALLOWED_SIZE];
    cw_case_key_allowed(key, allowed);
    if (key->presence == CW_KEY_REQUIRED)
      snprintf(fallback, sizeof fallback, "required");
    else if (key->presence == CW_KEY_COMPUTED)
      snprintf(fallback, sizeof fallback, "computed");
    else if (key->presence == CW_KEY_OPTIONAL)
      snprintf(fallback, sizeof fallback, "none");
    else if (key->presence == CW_KEY_AUTO)
      snprintf(fallback, sizeof fallback, "auto");
    else if (key->type == CW_KEY_CHOICE || key->type == CW_KEY_CHOICES)
      cw_case_key_chosen(key, key->fallback, fallback);
    else
      snprintf(fallback, sizeof fallback, "%.10g", key->fallback);
    fprintf(stream, "| `%s` | %s | %s | %s | %s |\n", key->key, key->unit[0] ? unit_text(key) : "-", allowed, fallback,
            key->meaning);
  }
  cw_units_markdown(stream);
}
