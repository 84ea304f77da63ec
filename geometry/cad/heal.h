// SPDX-License-Identifier: AGPL-3.0-or-later
// Makes the parts sound: valid and closed solids, without edges and faces that are smaller than the tolerance. A part
// that is sound already stays as it is, bit by bit. Method: tolerances that are greater than edges and faces need are
// taken back, then OpenCASCADE's ShapeFix and sewing. Nothing is lost: what makes several solids, or faces of another
// area, is no mended part.
#pragma once

#include "geometry/cad/cad_parts.h"
#include "pipeline/log.h"

#ifdef __cplusplus
extern "C" {
#endif

// What could not be healed.
typedef struct {
  int found;
  int part;
  double at[3]; // in the pump's coordinates, m
} CwCadFault;

// Heals all parts. `tolerance`: largest gap that is closed, in the model unit. CW_ERR_GEOMETRY where one stays open,
// invalid, without volume or of several solids; the message names domain, solid and file, the face by its name in the
// file and its number in fault.svg, what is wrong, the place in the file and, of an open edge, how far it is open.
// *fault then is that place, if any.
CwStatus cw_cad_heal(double tolerance, const CwCadFrame *frame, CwLog *log, CwCadParts *parts, CwCadFault *fault);

#ifdef __cplusplus
}
#endif
