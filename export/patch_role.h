// SPDX-License-Identifier: AGPL-3.0-or-later
// What a patch is for a solver, beyond its kind: whether it turns, and how its wall is treated.
#ifndef CUTWATER_EXPORT_PATCH_ROLE_H
#define CUTWATER_EXPORT_PATCH_ROLE_H

#include "export/assembly.h"
#include "export/template.h"
#include "pipeline/case.h"

// y+ from which the first cell counts as in the log layer: where the laws of the viscous sublayer and the log
// layer meet, y+ = ln(9.8 y+)/0.41.
#define CW_Y_PLUS_LAMINAR 11.225

// A wall that turns with the impeller; one that does so in a zone that rotates; and one in a zone that stands still,
// such as the shaft in a suction pipe.
int cw_patch_turns(const CwMesh *mesh, const CwModelPatch *patch);
int cw_patch_rotates(const CwMesh *mesh, const CwModelPatch *patch);
int cw_patch_is_shaft(const CwMesh *mesh, const CwModelPatch *patch);

// Whether the layers of a wall, by the y+ that they were made for, resolve the viscous sublayer or laminar flow;
// whether those of any wall do.
int cw_patch_resolved(const CwModelPatch *patch);
int cw_walls_resolved(const CwMesh *mesh);

typedef int (*CwPatchChoice)(const CwMesh *mesh, const CwModelPatch *patch);

// Whether any face of the mesh lies on the patch.
int cw_patch_is_there(const CwAssembly *assembly, int patch);

// Sets a value to the names of the patches that are there and `wanted`, with `between` between them.
CwStatus cw_patch_names_set(const CwAssembly *assembly, CwPatchChoice wanted, const char *between, const char *key,
                            CwValues *values);

#endif
