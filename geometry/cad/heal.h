// SPDX-License-Identifier: AGPL-3.0-or-later
// Makes the parts sound: valid and closed solids, without edges and faces that are smaller than the tolerance. A part
// that is sound already stays as it is, bit by bit. Method: OpenCASCADE's ShapeFix and sewing.
#ifndef CUTWATER_GEOMETRY_CAD_HEAL_H
#define CUTWATER_GEOMETRY_CAD_HEAL_H

#include "geometry/cad/cad_parts.h"

#ifdef __cplusplus
extern "C" {
#endif

// Heals all parts. `tolerance`: largest gap that is closed, in the model unit. CW_ERR_GEOMETRY, naming domain, face or
// edge and the place in the file, where one stays open, invalid or without volume.
CwStatus cw_cad_heal(double tolerance, const CwCadFrame *frame, CwCadParts *parts);

#ifdef __cplusplus
}
#endif
#endif
