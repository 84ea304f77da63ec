// SPDX-License-Identifier: AGPL-3.0-or-later
// The domains of a pump from CAD files, one closed solid each: the bodies that the case chooses, brought to the axis +z
// and to the model unit. What the file says of a face goes with it: a face that is cut or mended later has the name,
// colour and layer of the one that it lies on.
#pragma once

#include "geometry/cad/cad_file.h"
#include "geometry/cad/cad_frame.h"
#include "geometry/solid.h"
#include "pipeline/case_cad.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwCadParts CwCadParts;

// One part for each domain of the case; domain[i] is that of body i, or -1. Several bodies of a domain are fused. The
// unit follows from the size of those that rotate (solid.h). CW_ERR_INPUT where no domain rotates, or one that
// does has no size that a wheel has. *parts is the caller's to free, also after a failure.
CwStatus cw_cad_parts_make(const CwCaseCad *cad, const CwCadFrame *frame, const CwCadBodies *bodies, const int *domain,
                           CwCadParts **parts);
void cw_cad_parts_free(CwCadParts **parts);

int cw_cad_part_count(const CwCadParts *parts);
double cw_cad_parts_unit(const CwCadParts *parts); // m

// What the file says of a face; the texts are the part's.
typedef struct {
  const char *name; // "" without
  int colour;       // 0xRRGGBB, -1 without
  int number;       // of the face in the file that it is all or a piece of; pieces have the same number, others another
} CwCadFaceInfo;

// Faces count from 0.
int cw_cad_part_face_count(const CwCadParts *parts, int part);
CwCadFaceInfo cw_cad_part_face(const CwCadParts *parts, int part, int face);
// Name of the i-th layer of a face, from 0; the part's text. NULL behind the last.
const char *cw_cad_part_face_layer(const CwCadParts *parts, int part, int face, int i);

// A part as a solid of the stage. Patch, kind and name of its faces, in their order, are copied.
CwStatus cw_cad_part_solid(const CwCadParts *parts, int part, const char *const *patch, const CwPatchKind *kind,
                           CwSolid **solid);

#ifdef __cplusplus
}
#endif
