// SPDX-License-Identifier: AGPL-3.0-or-later
// The one call that fills a boundary: by the kernel, and by TetGen where the kernel does not recover all
// triangles or leave a cell that is flat.
#pragma once

#include "mesher/fill/fill.h"
#include "pipeline/case.h"

// Promises and errors of cw_tetgen_fill; fill->recovery says how it was done. With CW_FILL_TETGEN the kernel is not
// tried.
CwStatus cw_fill_with_fallback(const CwFillInput *input, CwFillMethod method, CwFill *fill);

// Least over the tetrahedra of six times the volume over the cube of the longest edge.
double cw_fill_flatness(const CwFill *fill);
