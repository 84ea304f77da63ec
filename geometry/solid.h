// SPDX-License-Identifier: AGPL-3.0-or-later
// One closed solid in a model unit with a patch for each face. Faces are counted from 0 in the order of
// TopExp::MapShapes(solid, TopAbs_FACE).
//
// The unit is D2 / 200. OpenCASCADE's absolute tolerances (1e-7) then mean the same share of every pump, and similar
// pumps have the same solids, bit by bit (design_unit.h). Of a drawn pump it is 2^k mm, so that its numbers, which are
// in millimetres, keep their bits.
#pragma once

#include "pipeline/model.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwSolid CwSolid; // solid.hpp shows its members to the C++ bridges

// The model unit, m, of a pump with the impeller outlet D2 > 0, m.
double cw_solid_unit_of_pump(double outlet_diameter);
// The same of a drawn one: D2 is 128 to 256 of them.
double cw_solid_unit_of_drawing(double outlet_diameter);

void cw_solid_free(CwSolid **solid);
const char *cw_solid_domain(const CwSolid *solid); // "rotor", "stator", "suction" or "discharge"
double cw_solid_unit(const CwSolid *solid);        // the model unit, m
int cw_solid_face_count(const CwSolid *solid);
const char *cw_solid_face_patch(const CwSolid *solid, int face);
CwPatchKind cw_solid_face_kind(const CwSolid *solid, int face);
const char *cw_solid_face_name(const CwSolid *solid, int face);

// Turns the solid into its mirror image in the plane z = 0, with the same faces in the same order: a pump of
// the other hand, which still turns about +z by the right hand.
CwStatus cw_solid_mirror(CwSolid *solid);

// Writes the solid, in its model unit, in OpenCASCADE's text format under a temporary name, then renames it. The same
// bits each time.
CwStatus cw_solid_write_brep(const CwSolid *solid, const char *path);

#ifdef __cplusplus
}
#endif
