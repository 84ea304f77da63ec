// SPDX-License-Identifier: AGPL-3.0-or-later
// A pump from CAD files: read, healed, divided, its faces surveyed and given patches, its interfaces found.
#pragma once

#include "geometry/cad/cad_model.h"
#include "geometry/cad/heal.h"
#include "geometry/solid.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  CwCadFrame frame;
  double tolerance; // m
  CwCadParts *parts;
  CwCadFault fault; // of the parts, where cw_cad_pump_read fails for one
  CwSurvey survey;
  CwContact *contact; // of each face
  CwFaceRole *role;   // of each face
  int blade_count;    // of equal passages; 1: none found
  CwFacePatches patches;
  int interface_count;
  CwCadInterface *interface;
} CwCadPump;

// Reads and prepares the solids up to the roles of the faces. Free with cw_cad_pump_free(), also after a failure;
// zeroed on entry.
CwStatus cw_cad_pump_read(const CwCaseCad *cad, CwLog *log, CwCadPump *pump);

// Gives the faces patches and finds the interfaces.
CwStatus cw_cad_pump_name(const CwCaseCad *cad, CwCadPump *pump);

// The parts as solids of the stage; `solids` holds one for each domain of the case, the caller's to free.
CwStatus cw_cad_pump_solids(const CwCadPump *pump, CwSolid **solids);

void cw_cad_pump_free(CwCadPump *pump);

#ifdef __cplusplus
}
#endif
