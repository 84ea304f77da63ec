// SPDX-License-Identifier: AGPL-3.0-or-later
// How sharply the walls are rounded towards the fluid, such as the noses of blades and of the tongue.
#ifndef CUTWATER_MESHER_CAD_FACE_RADIUS_H
#define CUTWATER_MESHER_CAD_FACE_RADIUS_H

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"

#ifdef __cplusplus
extern "C" {
#endif

// Of each CAD face, sets radius[face] (m or the unit of the model) to the convex radius of curvature that all but
// missed_share of its area have at least; INFINITY where more of it is flat or concave.
CwStatus cw_face_radii(const CwCad *cad, const CwBackground *background, double *radius);

#ifdef __cplusplus
}
#endif
#endif
