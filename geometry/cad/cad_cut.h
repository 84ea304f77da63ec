// SPDX-License-Identifier: AGPL-3.0-or-later
// Parts solids along a surface of revolution about the axis (cad.cut), so that a pump whose water is one solid gets a
// domain that rotates and one that does not. Both have the surface then, and so are an interface.
#pragma once

#include "geometry/cad/cad_file.h"
#include "geometry/cad/cad_frame.h"
#include "pipeline/log.h"

#ifdef __cplusplus
extern "C" {
#endif

// Replaces each body that the surface parts by its pieces, from the axis outward: NAME_1, NAME_2, and so on. What the
// file says of a face goes with its pieces; faces on the surface have nothing of it. Does nothing without cad.cut;
// CW_ERR_INPUT where the surface parts no body. A surface that passes an edge round the axis within `tolerance`, m, is
// moved onto it, and the log says so: beside it, it would leave strips as narrow as that.
CwStatus cw_cad_cut(const CwCaseCad *cad, const CwCadFrame *frame, double tolerance, CwLog *log, CwCadBodies *bodies);

#ifdef __cplusplus
}
#endif
