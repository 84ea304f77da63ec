// SPDX-License-Identifier: AGPL-3.0-or-later
// The polyMesh of OpenFOAM as files, before and while the regions are written into it (foam_region.h).
#pragma once

#include "export/foam_layout.h"

// Makes the files with everything but the values of the regions. Fails on all ranks alike. Collective.
CwStatus cw_foam_mesh_create(CwFoamMesh *mesh, const CwRanks *ranks);
