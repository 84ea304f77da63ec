// SPDX-License-Identifier: AGPL-3.0-or-later
// A look at a decomposition: what every plan holds, and its picture.
#pragma once

#include "mesher/cad/background.h"
#include "mesher/plan/plan.h"

// Checks what every plan holds: planes with unit normals, parents before their children, each region a leaf of one node
// (beside half-planes of two), each part of the tree reached from the root. CW_ERR_FAULT with the first that does not
// hold.
CwStatus cw_plan_audit(const CwPlan *plan);

// Writes the background triangles by the region of their centres as VTK PolyData (cell data region).
CwStatus cw_plan_vtk(const CwPlan *plan, const CwBackground *background, const char *path);
