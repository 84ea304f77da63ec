// SPDX-License-Identifier: AGPL-3.0-or-later
// Whether water can go from each part to all others, through faces that touch, and no part reaches into another.
#pragma once

#include "geometry/cad/face_patches.h"

#ifdef __cplusplus
extern "C" {
#endif

// CW_ERR_GEOMETRY where the middle of a face lies inside another part: with the volume of the overlap, and a place in
// it; and where parts are not joined to the first that rotates: with the least distance of faces that face one another,
// and its place. Parts with no opening and nothing near them are left to cw_cad_model_make. `tolerance`: m.
CwStatus cw_parts_joined(const CwCadParts *parts, const CwSurvey *survey, const CwContact *contact,
                         const CwCadFrame *frame, const CwCaseCad *cad, double tolerance, const CwFacePatches *patches);

#ifdef __cplusplus
}
#endif
