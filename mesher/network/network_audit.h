// SPDX-License-Identifier: AGPL-3.0-or-later
// A look at a curve network: what every network holds, and its picture.
#pragma once

#include "mesher/network/network.h"

// Checks what every network holds: fine polylines that begin and end at their corners, with lengths that rise from 0 by
// the way from point to point, points of cuts and lines on their planes, and a wall curve at the corners that are on
// walls, and at no other. CW_ERR_FAULT with the first that does not hold.
CwStatus cw_network_audit(const CwNetwork *network);

// Writes the curves as VTK PolyData (cell data kind: CwCurveKind; wall).
CwStatus cw_network_vtk(const CwNetwork *network, const char *path);
