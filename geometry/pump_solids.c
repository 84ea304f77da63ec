// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pump_solids.h"

#include <math.h>

#include "geometry/meridian.h"
#include "geometry/pipe_zone.h"
#include "geometry/rotor.h"
#include "geometry/stator.h"

static const double STUB = 0.25;      // of the diameter
static const double LEAST_ZONE = 0.25; // of the diameter
static const double OPEN_ZONE = 1;    // of the diameter, where the length is left open

static CwStatus check_zone(const char *what, double given, double stub, double diameter, const char *keys) {
  CwStatus status = CW_OK;
  CW_REQUIRE(given - stub >= LEAST_ZONE * diameter * (1 - 1e-9), CW_ERR_DESIGN,
             "the %s pipe of %.1f mm leaves %.1f mm to a zone of its own; it needs %.1f mm: raise %s to at least "
             "%.1f, or leave out %s",
             what, 1e3 * given, 1e3 * (given - stub), 1e3 * LEAST_ZONE * diameter,
             keys[0] == 's' ? "suction_pipe_length_mm" : "discharge_pipe_length_mm",
             1e3 * (stub + LEAST_ZONE * diameter), keys);
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
    CW_TRY(check_zone("suction", design->suction_pipe_length, stubs->suction, design->inlet_diameter,
                      "suction_pipe_zone"));
  }
  if (table->volute.discharge_pipe_zone == CW_PIPE_OWN_ZONE) {
    stubs->discharge = STUB * design->discharge_diameter;
    CW_TRY(check_zone("discharge", design->discharge_pipe_length, stubs->discharge, design->discharge_diameter,
                      "discharge_pipe_zone"));
  }
done:
  return status;
}

static CwStatus add_pipe(CwPumpSolids *pump, int neighbour, const char *end, double length,
                         const CwPipeZoneNames *names) {
  CwStatus status = CW_OK;
  CW_TRY(cw_pipe_zone_make(pump->solid[neighbour], end, length, names, &pump->solid[pump->count]));
  pump->interface[pump->interface_count++] =
      (CwPumpInterface){{cw_solid_domain(pump->solid[neighbour]), names->domain},
                        {names->neighbour_side, names->side}};
  pump->count++;
done:
  return status;
}

CwStatus cw_pump_solids_build(const CwCase *table, const CwDesign *design, const CwPipeStubs *stubs,
                              CwPumpSolids *pump) {
  CwStatus status = CW_OK;
  static const CwPipeZoneNames suction = {"suction", "inlet_pipe", "suction_to_rotor", "rotor_to_suction"};
  static const CwPipeZoneNames discharge = {"discharge", "outlet_pipe", "discharge_to_stator",
                                            "stator_to_discharge"};
  CwDesign cut = *design;
  cut.suction_pipe_length = stubs->suction;
  cut.volute.input.discharge_pipe_length = stubs->discharge;
  CW_TRY(cw_rotor_build(&cut, &pump->solid[CW_PUMP_ROTOR]));
  pump->count = 1;
  CW_TRY(cw_stator_build(&cut.volute, &pump->solid[CW_PUMP_STATOR]));
  pump->count = 2;
  pump->interface[pump->interface_count++] =
      (CwPumpInterface){{"rotor", "stator"}, {"rotor_interface", "stator_interface"}};
  if (table->impeller.suction_pipe_zone == CW_PIPE_OWN_ZONE)
    CW_TRY(add_pipe(pump, CW_PUMP_ROTOR, "inlet", design->suction_pipe_length - stubs->suction, &suction));
  if (table->volute.discharge_pipe_zone == CW_PIPE_OWN_ZONE)
    CW_TRY(add_pipe(pump, CW_PUMP_STATOR, "outlet", design->discharge_pipe_length - stubs->discharge, &discharge));
  for (int i = 0; i < pump->count && design->rotation == CW_ROTATION_CLOCKWISE; i++)
    CW_TRY(cw_solid_mirror(pump->solid[i]));
done:
  return status;
}

void cw_pump_solids_free(CwPumpSolids *pump) {
  for (int i = 0; i < CW_PUMP_DOMAINS_MOST; i++)
    cw_solid_free(&pump->solid[i]);
  pump->count = pump->interface_count = 0;
}
