// SPDX-License-Identifier: AGPL-3.0-or-later
// faces_sheet.csv: all faces of a pump from CAD files for people who name them. The columns are in docs/own-cad.md.
#pragma once

#include "geometry/cad/face_patches.h"

#ifdef __cplusplus
extern "C" {
#endif

// Whole or not at all. `patches`: NULL where the rules of the case have failed; then the columns patch and kind are
// empty.
CwStatus cw_faces_sheet_write(const CwCaseCad *cad, const CwCadFrame *frame, const CwCadParts *parts,
                              const CwSurvey *survey, const CwFaceRole *role, const CwFacePatches *patches,
                              const char *path);

#ifdef __cplusplus
}
#endif
