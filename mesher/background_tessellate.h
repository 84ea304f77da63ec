// SPDX-License-Identifier: AGPL-3.0-or-later
// The OpenCASCADE half of the background triangulation.
#ifndef CUTWATER_MESHER_BACKGROUND_TESSELLATE_H
#define CUTWATER_MESHER_BACKGROUND_TESSELLATE_H

#include "mesher/background.h"

#ifdef __cplusplus
extern "C" {
#endif

// Tessellates each face and welds the faces through the nodes of their common edges. Points: first those on
// CAD vertices, then along each edge, then inside each face. Does not check that the result is closed.
CwStatus cw_background_tessellate(CwCad *cad, double deflection, double angle, CwBackground *background);

#ifdef __cplusplus
}
#endif
#endif
