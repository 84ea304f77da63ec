// SPDX-License-Identifier: AGPL-3.0-or-later
// Cuts faces where the mesher needs edges: closed faces, so that no edge is a seam; faces with several points where a
// side of their parameters ends (poles), so that each has one at the most; faces with kinks in them. Method:
// OpenCASCADE's ShapeUpgrade.
#pragma once

#include "geometry/cad/cad_parts.h"
#include "pipeline/log.h"

#ifdef __cplusplus
extern "C" {
#endif

// Divides the faces of all parts that need it; the others stay. Closed faces get `pieces[part]` pieces, at least 2.
// CW_ERR_GEOMETRY, naming domain, face and the place in the file, where a seam or two poles of a face stay.
CwStatus cw_cad_divide(const int *pieces, const CwCadFrame *frame, CwLog *log, CwCadParts *parts);

#ifdef __cplusplus
}
#endif
