// SPDX-License-Identifier: AGPL-3.0-or-later
// The patch of each face: that of the first rule of cad.patches that takes it; else the name that the file gives the
// face; else what its form and place propose.
#pragma once

#include "geometry/cad/proposal.h"
#include "pipeline/model.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { CW_FROM_RULE, CW_FROM_FILE, CW_FROM_PROPOSAL } CwPatchSource;

typedef struct {
  char name[CW_NAME_SIZE];
  int part;
  CwPatchKind kind;
  CwPatchSource source;
  int rule;        // into CwCaseCad.patch; -1: none
  CwFaceRole role; // what most of its area is by itself
  double area;     // m2
} CwFacePatch;

typedef struct {
  int count;
  CwFacePatch *patch; // part after part, in the order of their first faces
  int *of_face;       // face_count of them
} CwFacePatches;

// `tolerance`, m: a point within it of an edge between faces chooses none of them. CW_ERR_INPUT, naming the key, where
// a name, colour, layer or point of a rule chooses no face, or all are earlier rules', a point lies near two faces or
// none, or a wall is asked for where parts touch. Free also after a failure; zeroed on entry.
CwStatus cw_face_patches_make(const CwCaseCad *cad, const CwCadFrame *frame, const CwCadParts *parts,
                              const CwSurvey *survey, const CwContact *contact, const CwFaceRole *role,
                              double tolerance, CwFacePatches *patches);
void cw_face_patches_free(CwFacePatches *patches);

const char *cw_face_role_name(CwFaceRole role);
const char *cw_patch_source_name(CwPatchSource source);

#ifdef __cplusplus
}
#endif
