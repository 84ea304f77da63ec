// SPDX-License-Identifier: AGPL-3.0-or-later
// A look at a size field on the surface that it belongs to: what it holds there, and its picture.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/size/size.h"

#ifdef __cplusplus
extern "C" {
#endif

// Checks that wanted edge lengths at all points of the background are above 0 and finite. CW_ERR_FAULT with the first
// that is not.
CwStatus cw_size_audit(const CwSize *size, const CwBackground *background);

// Writes the background triangles with the wanted edge length at their centres as VTK PolyData (cell data size_m).
CwStatus cw_size_vtk(const CwSize *size, const CwBackground *background, const char *path);

#ifdef __cplusplus
}
#endif
