// SPDX-License-Identifier: AGPL-3.0-or-later
// A surface as the input of a fill, and what a fill of it must be.
#pragma once

#include "closed_surfaces.h"
#include "mesher/fill/fill.h"

// Size field of a constant length; both must outlive the input.
CwFillInput fill_input(const Surface *surface, const double *size);

// NULL, or what is wrong: the points must be kept, all cells positive (exactly), the open faces the given
// triangles as they are turned, and none more, every point in use, and the volume the enclosed one.
const char *fill_fault(const Surface *surface, const CwFill *fill);

// Fails the test where there is a fault; the shape of the cells: degrees, and longest over shortest edge.
typedef struct {
  double dihedral_least, aspect_mean, aspect_most;
} FillShape;
FillShape check_fill(const Surface *surface, const CwFill *fill);
