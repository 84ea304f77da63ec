// SPDX-License-Identifier: AGPL-3.0-or-later
// Prisms so long for their height that checkMesh calls their determinant small (pipeline/mesh/cell.h): that of a right
// prism falls with the fourth power of height over length. They are sound, but the user should know whence they come.
#pragma once

#include "pipeline/mesh/cell.h"

// Determinant of the prism between the triangles `base` and `top`, with the base on the wall or not; all its other
// faces are inner ones.
double cw_prism_determinant(const double base[3][3], const double top[3][3], int on_wall);

// How many times as tall a prism of that determinant would have to be; above 1 where it is small.
double cw_thin_prism_wanted(double determinant);
