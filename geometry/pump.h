// SPDX-License-Identifier: AGPL-3.0-or-later
// Both solids of a pump: built, measured, and held against what makes a sound one.
#ifndef CUTWATER_GEOMETRY_PUMP_H
#define CUTWATER_GEOMETRY_PUMP_H

#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "geometry/solid.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_PUMP_ROTOR, CW_PUMP_STATOR, CW_PUMP_SOLIDS };

// Limits of a sound solid. The sizes are shares of D2: 0.1 mm and 0.1 mm on a wheel of 200 mm.
#define CW_PUMP_LARGEST_TOLERANCE 1e-6          // m
#define CW_PUMP_LEAST_EDGE 5e-4                 // of D2
#define CW_PUMP_LEAST_FACE 5e-4                 // of D2, width
#define CW_PUMP_VOLUME_TOLERANCE 1e-3           // rotor, to the volume of the sections
#define CW_PUMP_LARGEST_KINK (3 * M_PI / 180)   // rotor, between faces that should be smooth, rad

// What was measured on the solids as built.
typedef struct {
  CwMeasuredSolid rotor, stator;
  CwMeasuredRotor rotor_dimensions;
  CwMeasuredStator stator_dimensions;
  double rotor_volume_of_sections; // m3, by cw_rotor_volume()
} CwMeasuredPump;

// Builds the rotor or the stator of a design, mirrored where the pump turns the other way. The caller frees it.
CwStatus cw_pump_solid(const CwDesign *design, int which, CwSolid **solid);

// Measures both solids and holds them against the limits above and against one another: valid, closed, no edge
// too short, no face too narrow, the rotor's volume that of its sections, no kink where it should be smooth, the
// same interface on both sides. Fails with CW_ERR_GEOMETRY and one line that says what is wrong and what to
// change.
CwStatus cw_pump_measure(const CwDesign *design, const CwSolid *const solid[CW_PUMP_SOLIDS],
                         CwMeasuredPump *measured);

#ifdef __cplusplus
}
#endif
#endif
