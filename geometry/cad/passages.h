// SPDX-License-Identifier: AGPL-3.0-or-later
// Makes a wheel of z equal passages exactly z-fold symmetric, so that the mesher meshes one and turns it: CAD draws a
// hub in one piece, and its blades are alike within its tolerance alone. Faces of revolution are cut along z meridians;
// then all faces, edges and vertices are made anew as periodic images of those of one passage, in the order of the
// file's. A wheel whose passages are that already, but for rounding, keeps its bits.
#pragma once

#include "geometry/cad/cad_parts.h"
#include "pipeline/log.h"

#ifdef __cplusplus
extern "C" {
#endif

// Of part `part`, which has `count` passages about +z, no seams and no kinks. Copies lie within `tolerance`, in the
// model unit, of what they take the place of. A part that is not symmetric so far stays as it is, and the log says why.
CwStatus cw_cad_passages(int part, int count, double tolerance, CwLog *log, CwCadParts *parts);

#ifdef __cplusplus
}
#endif
