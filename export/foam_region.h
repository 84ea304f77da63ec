// SPDX-License-Identifier: AGPL-3.0-or-later
// What a region gives to the parts of a polyMesh.
#pragma once

#include "export/foam_layout.h"

// Writes the own points, the cells and the faces of a region into files that are there. A face between regions is
// written by that of the lower cell, to the parts of both. CW_ERR_IO.
CwStatus cw_foam_region_write(const CwFoamMesh *mesh, int region, const CwRegionData *data, const CwRegionFaces *faces);
