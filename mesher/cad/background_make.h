// SPDX-License-Identifier: AGPL-3.0-or-later
// Makes the background triangulation of a solid: its faces, welded, closed and with their normals out of the domain.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"
#include "mesher/parallel/context.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Tessellates with the given chord deflection (m) and angle (rad), both above 0 (CW_ERR_USAGE). Deterministic: the same
// bits as from faces that other ranks have made. Fails as the steps below do.
CwStatus cw_background_make(CwCad *cad, double deflection, double angle, CwBackground *background);

// From the faces (background_tessellate.h). Turns the solid where they enclose a volume below zero. Fails with
// CW_ERR_GEOMETRY where the result is not closed (the place is named) or encloses nothing. [out] background:
// cw_background_free. Collective; context: NULL for one process.
CwStatus cw_background_join(const CwContext *context, CwCad *cad, void *const *face_bytes, CwBackground *background);

#ifdef __cplusplus
}
#endif
