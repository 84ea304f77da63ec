// SPDX-License-Identifier: AGPL-3.0-or-later
// What each face is by its form and place alone, for faces that nobody has named. The rules:
//
//   a plane at the end of a part, all of its neighbours across it, none of them a contact,
//   the water behind it no flat chamber:                                                     inlet or outlet
//   a surface of revolution about the axis in what rotates:                                  hub or shroud
//   one of z like faces, a z-th of a turn apart, in what rotates:                            blade
//   what runs straight away from an inlet or outlet, round an axis of its own:               pipe
//
// Hub and shroud are told apart by the side that the water comes from; with two eyes each half of the wheel has its
// own. All others are walls, and so are rings of a casing that go round the wheel. A proposal is told as one.
#pragma once

#include "geometry/cad/contact.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  CW_ROLE_WALL,
  CW_ROLE_CONTACT,
  CW_ROLE_INLET,
  CW_ROLE_OUTLET,
  CW_ROLE_HUB,
  CW_ROLE_SHROUD,
  CW_ROLE_BLADE,
  CW_ROLE_PIPE
} CwFaceRole;

// Sets the role of each face, `role` holds face_count of them, and *blade_count: the z of most area, or 1.
// `rotating`: for each part.
CwStatus cw_proposal_make(const CwSurvey *survey, const CwContact *contact, const int *rotating, CwFaceRole *role,
                          int *blade_count);

#ifdef __cplusplus
}
#endif
