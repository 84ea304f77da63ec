// SPDX-License-Identifier: AGPL-3.0-or-later
// The pump's domains as solids: built, measured, and held against what makes a sound one; and the interfaces
// between them. Rotor and stator always; the suction pipe and the discharge pipe where the case asks for them as
// zones of their own.
#pragma once

#include "geometry/design.h"
#include "geometry/measure.h"
#include "geometry/solid.h"
#include "pipeline/case.h"
#include "pipeline/model.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_PUMP_ROTOR, CW_PUMP_STATOR, CW_PUMP_DOMAINS_MOST = 4 };

// Limits of a sound solid. The sizes are shares of D2: 2 um, 0.04 mm and 0.04 mm on a wheel of 200 mm.
#define CW_PUMP_LARGEST_TOLERANCE 1e-5        // of D2, a twentieth of the shortest edge
#define CW_PUMP_LEAST_EDGE 2e-4               // of D2
#define CW_PUMP_LEAST_FACE 2e-4               // of D2, width
#define CW_PUMP_VOLUME_TOLERANCE 1e-3         // rotor, to the volume of the sections
#define CW_PUMP_LARGEST_KINK (3 * M_PI / 180) // rotor, between faces that should be smooth, rad

// One surface that two domains have in common, as a patch of either.
typedef struct {
  const char *patch[2];
  CwInterfaceSurface surface; // a cylinder is the one of the design's interface radius
} CwPumpInterface;

// How much of the suction and discharge pipes belongs to rotor and stator, m: all, or where a pipe is a zone of
// its own, up to a quarter of a diameter before the hub's nut and behind the diffuser.
typedef struct {
  double suction, discharge;
} CwPipeStubs;

typedef struct {
  int count, interface_count;
  CwSolid *solid[CW_PUMP_DOMAINS_MOST]; // rotor, stator, then the pipes
  CwPumpInterface interface[CW_PUMP_DOMAINS_MOST - 1];
  CwPipeStubs stubs; // as built
} CwPump;

// What was measured on the solids as built.
typedef struct {
  CwMeasuredSolid solid[CW_PUMP_DOMAINS_MOST]; // in the order of the pump's
  CwMeasuredRotor rotor;
  CwMeasuredStator stator;
  double rotor_volume_of_sections; // m3, by cw_rotor_volume()
} CwMeasuredPump;

// Where the suction pipe is a zone and its length is left open, the design gets one that leaves a diameter to
// the zone. Fails with CW_ERR_DESIGN where a length leaves less than a quarter of a diameter to a zone.
CwStatus cw_pump_pipe_stubs(const CwCase *table, CwDesign *design, CwPipeStubs *stubs);

// Builds all domains; mirrored where the pump turns clockwise. Free with cw_pump_free(), also after a failure;
// zeroed `pump` on entry.
CwStatus cw_pump_build(const CwCase *table, const CwDesign *design, const CwPipeStubs *stubs, CwPump *pump);
void cw_pump_free(CwPump *pump);

// Measures all solids and holds them against the limits above and rotor and stator against one another: valid,
// closed, no edge too short, no face too narrow, the rotor's volume that of its sections, no kink where it should
// be smooth, the same interface on both sides. Fails with CW_ERR_GEOMETRY and one line that says what is wrong and
// what to change.
CwStatus cw_pump_measure(const CwDesign *design, const CwPump *pump, CwMeasuredPump *measured);

// What to change in the case where a face of a domain has a sharp corner: those of the wheel lie where blades end on
// its walls, those of the casing beside the tongue. Nothing that is not there is to be left out, nothing in use taken.
const char *cw_pump_blunter_corner(const CwDesign *design, const char *domain);

// The same where the trailing edge has a sharp wedge. The length of a bevel does not change its wedges.
const char *cw_pump_blunter_edge(const CwDesign *design);

#ifdef __cplusplus
}
#endif
