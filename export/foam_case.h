// SPDX-License-Identifier: AGPL-3.0-or-later
// The OpenFOAM case around the mesh: dictionaries, fields at the start, scripts.
#pragma once

#include "export/assembly.h"
#include "export/patch_role.h"
#include "pipeline/case.h"

// Writes the case (but for constant/polyMesh) into `folder`. One rank calls it. CW_ERR_IO.
CwStatus cw_foam_case_write(const char *folder, const CwCase *table, const CwAssembly *assembly);

// How many ranks the case's scripts take of themselves for a whole mesh of so many cells, in words of a shell: one, or
// on large meshes as many as the machine has cores.
const char *cw_foam_usual_ranks(int64_t cells);
