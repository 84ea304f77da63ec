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

// A wall that turns with the impeller: the walls of the rotor but for the suction pipe.
int cw_patch_rotates(const CwMeshPatch *patch);

// A wall that turns in a zone that does not: the shaft in a suction pipe of its own.
int cw_patch_is_shaft(const CwMeshPatch *patch);

// Whether the layers of a wall, by the y+ that they were made for, resolve the viscous sublayer or laminar flow; whether
// those of any wall do.
int cw_patch_resolved(const CwMeshPatch *patch);
int cw_walls_resolved(const CwMesh *mesh);

typedef int (*CwPatchChoice)(const CwMeshPatch *patch);

// Whether any face of the mesh lies on the patch.
int cw_patch_is_there(const CwAssembly *assembly, int patch);

// Sets a value to the names of the patches that are there and `wanted`, with `between` between them.
CwStatus cw_patch_names_set(const CwAssembly *assembly, CwPatchChoice wanted, const char *between, const char *key,
                            CwValues *values);

#endif
