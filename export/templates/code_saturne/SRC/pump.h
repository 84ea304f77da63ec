// SPDX-License-Identifier: AGPL-3.0-or-later
// The numbers and groups of @case@, in SI units. Groups of faces are joined with "or"; no_group[] selects none.
#ifndef PUMP_H
#define PUMP_H

#define PUMP_TURBULENCE @turbulence@
#define PUMP_ITERATIONS 500 // in all; with more of them ./run goes on
#define PUMP_SECOND_ORDER 0 // share of it in the velocity's convection: with 1 the flow does not come to rest
#define PUMP_SPEED @speed@ // rad/s about +z
#define PUMP_FLOW @flow_rate@
#define PUMP_DENSITY @density@
#define PUMP_KINEMATIC_VISCOSITY @viscosity@
#define PUMP_PRESSURE @inlet_pressure@
#define PUMP_ROUGHNESS @roughness_length@ // of the law ln((y + this) / this); 0.0: smooth
#define PUMP_PASSAGE_SPEED @passage_speed@
#define PUMP_PASSAGE_WIDTH @passage_width@
#define PUMP_INLET_K @inlet_k@
#define PUMP_INLET_EPSILON @inlet_epsilon@

#define PUMP_ROTOR "@rotor_zones@"
#define PUMP_TURNING_WALLS "@turning_walls@"
#define PUMP_STANDING_WALLS "@standing_walls@" // in the rotor
#define PUMP_SHAFTS "@shafts@"                 // turning walls elsewhere
#define PUMP_SYMMETRIES "@symmetries@"
#define PUMP_INLETS "@inlets@"
#define PUMP_OUTLET_GROUPS "@outlets@"

// Of them the first has a pressure, the others their shares of the flow.
typedef struct {
  const char *group;
  double share;
} PumpOutlet;
static const PumpOutlet pump_outlets[] __attribute__((unused)) = {@outlet_shares@};
enum { PUMP_OUTLETS = sizeof pump_outlets / sizeof *pump_outlets };

// Both sides of each interface, and the areas of all sides together (m2).
static const char *const pump_interfaces[] __attribute__((unused)) = {@interfaces@};
enum { PUMP_INTERFACES = sizeof pump_interfaces / sizeof *pump_interfaces };
#define PUMP_INTERFACE_AREA @interface_area@

#endif
