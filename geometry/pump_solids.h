// SPDX-License-Identifier: AGPL-3.0-or-later
// The pump's domains as solids, and the interfaces between them. Rotor and stator always; the suction pipe and
// the discharge pipe where the case asks for them as zones of their own.
#ifndef CUTWATER_GEOMETRY_PUMP_SOLIDS_H
#define CUTWATER_GEOMETRY_PUMP_SOLIDS_H

#include "geometry/hydraulic_design.h"
#include "geometry/solid.h"
#include "pipeline/case.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_PUMP_ROTOR, CW_PUMP_STATOR, CW_PUMP_DOMAINS_MOST = 4 };

// One surface that two domains have in common, as a patch of either.
typedef struct {
  const char *domain[2], *patch[2];
} CwPumpInterface;

typedef struct {
  int count, interface_count;
  CwSolid *solid[CW_PUMP_DOMAINS_MOST]; // rotor, stator, then the pipes
  CwPumpInterface interface[CW_PUMP_DOMAINS_MOST - 1];
} CwPumpSolids;

// How much of the suction and discharge pipes belongs to rotor and stator, m: all, or where a pipe is a zone of
// its own, up to a quarter of a diameter before the hub's nut and behind the diffuser.
typedef struct {
  double suction, discharge;
} CwPipeStubs;

// Where the suction pipe is a zone and its length is left open, the design gets one that leaves a diameter to
// the zone. Fails with CW_ERR_DESIGN where a length leaves less than a quarter of a diameter to a zone.
CwStatus cw_pump_pipe_stubs(const CwCase *table, CwDesign *design, CwPipeStubs *stubs);

// Builds all domains; mirrored where the pump turns clockwise. Free with cw_pump_solids_free(), also after a
// failure; zeroed `pump` on entry.
CwStatus cw_pump_solids_build(const CwCase *table, const CwDesign *design, const CwPipeStubs *stubs,
                              CwPumpSolids *pump);
void cw_pump_solids_free(CwPumpSolids *pump);

#ifdef __cplusplus
}
#endif
#endif
