// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pump.h"

#include <math.h>
#include <string.h>

#include "geometry/meridian.h"
#include "geometry/pipe_zone.h"
#include "geometry/rotor.h"
#include "geometry/rotor_volume.h"
#include "geometry/stator.h"

static const double STUB = 0.25;       // of the diameter
static const double LEAST_ZONE = 0.25; // of the diameter
static const double OPEN_ZONE = 1;     // of the diameter, where the length is left open

// At the end of lines on what no value of the case should bring about.
#define OWN_FAULT "a fault of the program, please report it with the case"

static CwStatus check_zone(const char *what, double given, double stub, double diameter) {
  CwStatus status = CW_OK;
  const double least = stub + LEAST_ZONE * diameter * (1 - 1e-9);
  CW_REQUIRE(given >= least, CW_ERR_DESIGN,
             "the %s pipe of %.1f mm leaves %.1f mm to a zone of its own; it needs %.1f mm: raise "
             "%s_pipe_length_mm to at least %.1f, or leave out %s_pipe_zone",
             what, 1e3 * given, 1e3 * (given - stub), 1e3 * LEAST_ZONE * diameter, what, ceil(1e4 * least) / 10, what);
done:
  return status;
}

CwStatus cw_pump_pipe_stubs(const CwCase *table, CwDesign *design, CwPipeStubs *stubs) {
  CwStatus status = CW_OK;
  stubs->suction = design->suction_pipe_length;
  stubs->discharge = design->discharge_pipe_length;
  if (table->impeller.suction_pipe_zone == CW_PIPE_OWN_ZONE) {
    CwMeridian meridian;
    CW_TRY(cw_meridian_make(design, &meridian));
    const double nut = fmax(0, meridian.shroud.pole[0][1] - meridian.nut_end_z);
    stubs->suction = nut + STUB * design->inlet_diameter;
    if (!cw_case_given(table->impeller.suction_pipe_length)) {
      design->suction_pipe_length = stubs->suction + OPEN_ZONE * design->inlet_diameter;
      design->source[CW_DESIGN_suction_pipe_length] = "past the nut, 1.25 D1";
    }
    CW_TRY(check_zone("suction", design->suction_pipe_length, stubs->suction, design->inlet_diameter));
  }
  if (table->volute.discharge_pipe_zone == CW_PIPE_OWN_ZONE) {
    stubs->discharge = STUB * design->discharge_diameter;
    CW_TRY(check_zone("discharge", design->discharge_pipe_length, stubs->discharge, design->discharge_diameter));
  }
done:
  return status;
}

static CwStatus add_pipe(CwPump *pump, int neighbour, const char *end, double length, const CwPipeZoneNames *names) {
  CwStatus status = CW_OK;
  CW_TRY(cw_pipe_zone_make(pump->solid[neighbour], end, length, names, &pump->solid[pump->count]));
  pump->interface[pump->interface_count++] = (CwPumpInterface){{names->neighbour_side, names->side}, CW_SURFACE_PLANE};
  pump->count++;
done:
  return status;
}

CwStatus cw_pump_build(const CwCase *table, const CwDesign *design, const CwPipeStubs *stubs, CwPump *pump) {
  CwStatus status = CW_OK;
  static const CwPipeZoneNames suction = {"suction", "inlet_pipe", "hub_shaft_pipe", "suction_to_rotor",
                                          "rotor_to_suction"};
  static const CwPipeZoneNames discharge = {"discharge", "outlet_pipe", "", "discharge_to_stator",
                                            "stator_to_discharge"};
  CwDesign cut = *design;
  pump->stubs = *stubs;
  cut.suction_pipe_length = stubs->suction;
  cut.volute.input.discharge_pipe_length = stubs->discharge;
  CW_TRY(cw_rotor_build(&cut, &pump->solid[CW_PUMP_ROTOR]));
  pump->count = 1;
  CW_TRY(cw_stator_build(&cut.volute, cw_solid_unit(pump->solid[CW_PUMP_ROTOR]), &pump->solid[CW_PUMP_STATOR]));
  pump->count = 2;
  pump->interface[pump->interface_count++] =
      (CwPumpInterface){{"rotor_interface", "stator_interface"}, CW_SURFACE_CYLINDER};
  if (table->impeller.suction_pipe_zone == CW_PIPE_OWN_ZONE)
    CW_TRY(add_pipe(pump, CW_PUMP_ROTOR, "inlet", design->suction_pipe_length - stubs->suction, &suction));
  if (table->volute.discharge_pipe_zone == CW_PIPE_OWN_ZONE)
    CW_TRY(add_pipe(pump, CW_PUMP_STATOR, "outlet", design->discharge_pipe_length - stubs->discharge, &discharge));
  for (int i = 0; i < pump->count && design->rotation == CW_ROTATION_CLOCKWISE; i++)
    CW_TRY(cw_solid_mirror(pump->solid[i]));
done:
  return status;
}

void cw_pump_free(CwPump *pump) {
  for (int i = 0; i < CW_PUMP_DOMAINS_MOST; i++) cw_solid_free(&pump->solid[i]);
  pump->count = pump->interface_count = 0;
}

// The keys of the case that make a face too small, by a part of its name.
static const char *maker_of(const char *face) {
  static const char *const makers[][2] = {
      {"_root", "root_fillet_radius_mm, or leave it out"},
      {"hub_nut", "hub_nut_flat_diameter_mm"},
      {"trailing", "trailing_edge_thickness_mm or trailing_edge_bevel_mm"},
      {"leading", "leading_edge_thickness_mm"},
      {"tongue", "tongue_radius_mm"},
      {"step", "inlet_width_mm"},
      {"neck", "base_diameter_mm"},
      {"diffuser", "diffuser_length_mm"},
      {"suction_pipe", "suction_pipe_length_mm"},
      {"discharge", "discharge_pipe_length_mm"},
  };
  for (size_t i = 0; i < sizeof makers / sizeof *makers; i++)
    if (strstr(face, makers[i][0])) return makers[i][1];
  return "the dimension that makes it";
}

const char *cw_pump_blunter_corner(const CwDesign *design, const char *domain) {
  const int bevelled = design->trailing_edge == CW_EDGE_BEVELLED, filleted = design->root_fillet_radius > 0;
  if (strcmp(domain, "rotor"))
    return cw_case_given(design->volute.input.tongue_angle) ? "raise tongue_angle_deg, or leave it out"
           : cw_case_given(design->volute.input.tongue_gap) ? "raise tongue_gap_mm, or leave it out"
                                                            : "give a tongue_gap_mm greater than that of the design";
  return filleted && bevelled ? "leave out root_fillet_radius_mm"
         : filleted           ? "leave out root_fillet_radius_mm, or take trailing_edge bevelled"
         : !bevelled          ? "take trailing_edge bevelled"
                              : "change leading_edge_radius_hub_mm or leading_edge_radius_shroud_mm";
}

const char *cw_pump_blunter_edge(const CwDesign *design) {
  return design->trailing_edge == CW_EDGE_BEVELLED ? "take trailing_edge rounded"
                                                   : "take trailing_edge bevelled or rounded";
}

static CwStatus check_solid(const CwDesign *design, const CwSolid *solid, const CwMeasuredSolid *measured) {
  CwStatus status = CW_OK;
  const double edge = CW_PUMP_LEAST_EDGE * design->outlet_diameter, face = CW_PUMP_LEAST_FACE * design->outlet_diameter;
  const double tolerance = CW_PUMP_LARGEST_TOLERANCE * design->outlet_diameter;
  CW_REQUIRE(!measured->fault[0], CW_ERR_GEOMETRY,
             "%s: %s (%.3f cm3, %d faces); allowed: a valid and closed solid: " OWN_FAULT, cw_solid_domain(solid),
             measured->fault, measured->volume * 1e6, measured->face_count);
  CW_REQUIRE(measured->largest_tolerance < tolerance, CW_ERR_GEOMETRY,
             "%s: the tolerance of face %s or its edges is %.3g mm; allowed: under %.3g mm: " OWN_FAULT,
             cw_solid_domain(solid), cw_solid_face_name(solid, measured->loosest), measured->largest_tolerance * 1e3,
             tolerance * 1e3);
  CW_REQUIRE(measured->shortest_edge > edge, CW_ERR_GEOMETRY,
             "%s: the shortest edge, of %s, is %.3g mm long; at least %.3g mm are allowed: raise %s",
             cw_solid_domain(solid), cw_solid_face_name(solid, measured->shortest_of), measured->shortest_edge * 1e3,
             edge * 1e3, maker_of(cw_solid_face_name(solid, measured->shortest_of)));
  CW_REQUIRE(measured->narrowest_face > face, CW_ERR_GEOMETRY,
             "%s: the narrowest face, %s, is %.3g mm wide; at least %.3g mm are allowed: raise %s",
             cw_solid_domain(solid), cw_solid_face_name(solid, measured->narrowest), measured->narrowest_face * 1e3,
             face * 1e3, maker_of(cw_solid_face_name(solid, measured->narrowest)));
done:
  return status;
}

static CwStatus check_rotor(const CwDesign *design, const CwPump *pump, CwMeasuredPump *measured) {
  CwStatus status = CW_OK;
  const CwMeasuredAngle *kink = &measured->rotor.kink;
  const double volume = measured->solid[CW_PUMP_ROTOR].volume;
  CwDesign cut = *design;
  cut.suction_pipe_length = pump->stubs.suction;
  CW_TRY(cw_rotor_volume(&cut, &measured->rotor_volume_of_sections));
  CW_REQUIRE(
      fabs(volume / measured->rotor_volume_of_sections - 1) < CW_PUMP_VOLUME_TOLERANCE, CW_ERR_GEOMETRY,
      "rotor: the solid has %.3f cm3, the sections of meridian and blades %.3f cm3; allowed: %.2g %% apart: " OWN_FAULT,
      volume * 1e6, measured->rotor_volume_of_sections * 1e6, 100 * CW_PUMP_VOLUME_TOLERANCE);
  CW_REQUIRE(
      kink->angle<CW_PUMP_LARGEST_KINK, CW_ERR_GEOMETRY,
                  "rotor: faces that should be smooth meet with a kink of %.2f deg at (%.2f, %.2f, %.2f) mm; %.0f deg "
                  "are allowed: lower %sleading_edge_ratio",
                  kink->angle / CW_DEGREE, kink->at[0] * 1e3, kink->at[1] * 1e3, kink->at[2] * 1e3,
                  CW_PUMP_LARGEST_KINK / CW_DEGREE, design->root_fillet_radius> 0
          ? "root_fillet_radius_mm or "
          : "");
done:
  return status;
}

// Both sides of the interface must be the same cylinder, so that every weight of the coupling is 1.
static CwStatus check_interface(const CwMeasuredRotor *rotor, const CwMeasuredStator *stator) {
  CwStatus status = CW_OK;
  CW_REQUIRE(fabs(rotor->interface_radius / stator->interface_radius - 1) < 1e-7 &&
                 fabs(rotor->interface_area / stator->interface_area - 1) < 1e-6,
             CW_ERR_GEOMETRY,
             "rotor_interface has r = %.6f mm and %.4f mm2, stator_interface r = %.6f mm and %.4f mm2; allowed: the "
             "same on both sides: " OWN_FAULT,
             rotor->interface_radius * 1e3, rotor->interface_area * 1e6, stator->interface_radius * 1e3,
             stator->interface_area * 1e6);
done:
  return status;
}

CwStatus cw_pump_measure(const CwDesign *design, const CwPump *pump, CwMeasuredPump *measured) {
  CwStatus status = CW_OK;
  for (int i = 0; i < pump->count; i++) {
    CW_TRY(cw_measure_solid(pump->solid[i], &measured->solid[i]));
    CW_TRY(check_solid(design, pump->solid[i], &measured->solid[i]));
  }
  CW_TRY(cw_measure_rotor(pump->solid[CW_PUMP_ROTOR], &measured->rotor));
  CW_TRY(cw_measure_stator(pump->solid[CW_PUMP_STATOR], &measured->stator));
  CW_TRY(check_rotor(design, pump, measured));
  CW_TRY(check_interface(&measured->rotor, &measured->stator));
done:
  return status;
}
