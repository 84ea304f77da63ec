// SPDX-License-Identifier: AGPL-3.0-or-later
// The small files of a polyMesh: `boundary`, `faceZones` of several inlets or outlets, and boundaryProcAddressing.
#pragma once

#include "export/foam_layout.h"

// Writes them for a part whose faces are laid out into `folder`. CW_ERR_IO.
CwStatus cw_foam_boundary_write(const CwFoamMesh *mesh, int part, const char *folder);
