// SPDX-License-Identifier: AGPL-3.0-or-later
// Fills the triangulation of a patch with points in fronts that start at the given edges, each point where it
// makes an equilateral triangle on an edge of the front (S. Rebay, "Efficient unstructured mesh generation by
// means of Delaunay triangulation and Bowyer-Watson algorithm", J. Comput. Phys. 106, 1993), lengths being
// those on the surface.
#pragma once

#include "mesher/surface/patch_work.h"

CwStatus cw_patch_front(CwPatchWork *work);
