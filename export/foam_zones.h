// SPDX-License-Identifier: AGPL-3.0-or-later
// What an OpenFOAM case says of the zones of the mesh: which turn, and what is reported of the flow through their ends
// and interfaces.
#pragma once

#include "export/patch_role.h"

// Sets "mrf_zones", "mesh_motion" and "rotating_zones", which need "speed"; the ends' lines "inlet_region",
// "outlet_region", "inlet_flow", "outlet_flow"; and "rotor_interface", "stator_interface" and
// "interface_flows": the sides of the first interface of a zone that turns with one that does not, and of the others.
CwStatus cw_foam_zones_set(const CwAssembly *assembly, CwValues *values);

// The zone of faces that several inlets or outlets are together.
const char *cw_foam_end_zone(CwPatchKind kind);
