// SPDX-License-Identifier: AGPL-3.0-or-later
// The surfaces along which two parts touch, such as a wheel's eye and its outlet where one casing has both: faces that
// go on smoothly into one another, what they touch, and faces beside them on the same surface of revolution.
//
//   r |        ___ 0          surface 0: farthest from the axis
//     |     __/   |
//     |  __/      |
//     | 1|________|           then by z, from the lowest
//     +------------- z
#pragma once

#include "geometry/cad/face_patches.h"

#ifdef __cplusplus
extern "C" {
#endif

// [out] number: of each face that of its surface among all of its two parts, the same on both sides; -1: it touches
// none. `number` holds face_count of them. `tolerance`: of places, m.
CwStatus cw_contact_surfaces(const CwCaseCad *cad, const CwSurvey *survey, const CwContact *contact, double tolerance,
                             int *number);

// Gives proposed patches that hold several surfaces one patch for each: the least number keeps the name, others have
// theirs, counted from 1, behind it. Surfaces that a named patch of the other side holds together stay together. New
// patches stand behind the others of their part.
CwStatus cw_contact_patches_part(const CwCaseCad *cad, const CwSurvey *survey, const CwContact *contact,
                                 double tolerance, CwFacePatches *patches);

#ifdef __cplusplus
}
#endif
