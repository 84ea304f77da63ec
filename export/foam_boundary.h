// SPDX-License-Identifier: AGPL-3.0-or-later
// The small files of a polyMesh: `boundary`, `faceZones` of several inlets or outlets, and boundaryProcAddressing.
#ifndef CUTWATER_EXPORT_FOAM_BOUNDARY_H
#define CUTWATER_EXPORT_FOAM_BOUNDARY_H

#include "export/foam_layout.h"

// Writes them for a part whose faces are laid out into `folder`. CW_ERR_IO.
CwStatus cw_foam_boundary_write(const CwFoamMesh *mesh, int part, const char *folder);

#endif
