// SPDX-License-Identifier: AGPL-3.0-or-later
// What a patch is for a solver, beyond its kind: whether it turns, and how its wall is treated; and which model of
// turbulence follows from the walls.
#pragma once

#include "export/assembly.h"
#include "export/template.h"
#include "pipeline/case.h"

// y+ from which the first cell counts as in the log layer: where the laws of the viscous sublayer and the log
// layer meet, y+ = ln(9.8 y+)/0.41.
#define CW_Y_PLUS_LAMINAR 11.225

// A wall that turns with the impeller, and one that does not; one that turns in a zone that rotates, and one in a zone
// that stands still, such as the shaft in a suction pipe.
int cw_patch_turns(const CwMesh *mesh, const CwModelPatch *patch);
int cw_patch_stands(const CwMesh *mesh, const CwModelPatch *patch);
int cw_patch_rotates(const CwMesh *mesh, const CwModelPatch *patch);
int cw_patch_is_shaft(const CwMesh *mesh, const CwModelPatch *patch);

// Whether the layers of a wall, by the y+ that they were made for, resolve the viscous sublayer or laminar flow.
int cw_patch_resolved(const CwModelPatch *patch);

// By the walls of all zones: laminar where the flow along each of them is, k-epsilon with wall functions where none is
// resolved, else SST (F. R. Menter, 1994), which takes any y+.
typedef enum { CW_K_EPSILON, CW_SST, CW_LAMINAR, CW_TURBULENCE_MODELS } CwTurbulenceModel;
CwTurbulenceModel cw_turbulence_model(const CwMesh *mesh);

// As the record has it.
const char *cw_turbulence_model_name(CwTurbulenceModel model);

// The patches of a kind, there or not.
int cw_patch_kind_count(const CwMesh *mesh, CwPatchKind kind);

// Whether any face of the mesh lies on the patch.
int cw_patch_is_there(const CwAssembly *assembly, int patch);

// The patches that are there and `wanted` (NULL: all), of a domain or of all (-1): how many, and a value of their names
// with `between` between them.
typedef int (*CwPatchChoice)(const CwMesh *mesh, const CwModelPatch *patch);
int cw_patch_count(const CwAssembly *assembly, int domain, CwPatchChoice wanted);
CwStatus cw_patch_names_set(const CwAssembly *assembly, int domain, CwPatchChoice wanted, const char *between,
                            const char *key, CwValues *values);
