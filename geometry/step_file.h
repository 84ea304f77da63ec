// SPDX-License-Identifier: AGPL-3.0-or-later
// STEP AP214 in mm: one product a solid, named by its domain; each face named by its patch; numbers with all digits.
#pragma once

#include "geometry/beside.h"
#include "geometry/solid.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Writes `count` solids, whole or not at all. The same bits each time: the header's time stamp is fixed.
CwStatus cw_step_write(const CwSolid *const *solids, int count, const char *path);

// The same beside the caller (beside.h), and each face once more as a shell that is a product with the name of its
// patch: gmsh and FreeCAD show the names of products, not those of faces. gmsh gives the names to the solids' own
// faces, where they coincide.
CwStatus cw_step_write_with_faces(const CwSolid *const *solids, int count, const char *path, CwBeside **beside);

#ifdef __cplusplus
}
#endif
