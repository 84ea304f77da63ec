// SPDX-License-Identifier: AGPL-3.0-or-later
// The OpenCASCADE half of the background triangulation, face by face: every rank divides the edges, any rank makes a
// face, and all ranks weld the same faces.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/cad/cad.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// The divided edges of a solid, whose triangulation by the library it holds while it lives: one at a time. The same on
// all ranks.
typedef struct CwTessellation CwTessellation;

// Chord deflection in m, angle in rad, both greater than zero. CW_ERR_LIBRARY where OpenCASCADE fails, as below.
CwStatus cw_tessellation_start(const CwCad *cad, double deflection, double angle, CwTessellation **tessellation);
void cw_tessellation_free(CwTessellation **tessellation);

// What a face may cost, in points on its edges.
double cw_tessellation_cost(const CwTessellation *tessellation, int face);

// Triangulates a face into a block of bytes (malloc'd). CW_ERR_GEOMETRY where the library cannot.
CwStatus cw_tessellation_face(const CwTessellation *tessellation, int face, void **bytes, int64_t *byte_count);

// Welds all faces (bytes[face]) through the nodes of their common edges. Points: first those on CAD vertices, then
// along each edge, then inside each face. Does not check that the result is closed.
CwStatus cw_tessellation_weld(const CwCad *cad, void *const *bytes, CwBackground *background);

#ifdef __cplusplus
}
#endif
