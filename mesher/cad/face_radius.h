// SPDX-License-Identifier: AGPL-3.0-or-later
// How sharply the walls are rounded: towards the fluid, as noses of blades and of the tongue are, and away from it, as
// the fillets at their roots are.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_CONVEX, CW_CONCAVE, CW_BENDS };

// Of each CAD face, sets radius[face][] (m or the unit of the model) to the radius of curvature that all but
// missed_share of its area have at least, bent towards the fluid (CW_CONVEX) and away from it (CW_CONCAVE); INFINITY
// where more of it is not bent so.
CwStatus cw_face_radii(const CwCad *cad, const CwBackground *background, double (*radius)[CW_BENDS]);

#ifdef __cplusplus
}
#endif
