// SPDX-License-Identifier: AGPL-3.0-or-later
// The surfaces of one blade or splitter of the rotor, as tensor B-splines through grids of (q, theta) points:
// pressure and suction side, leading edge, bevel and trailing edge. Neighbouring surfaces interpolate the same
// rows of points, so that their common edges are exact on both.
//
// With root fillets each of them is cut into three bands from hub to shroud: fillet, blade, fillet.
#pragma once

#include "geometry/blade_shape.hpp"
#include "geometry/design.h"
#include "geometry/meridian.h"

// Makes all surfaces and curves of a shape whose name and sections are set, of a design in the model unit. The lines
// from its nose to the eye turn into the meridian within a fifth of the angle `room`. Throws std::runtime_error with
// the reason where the trailing edge or the root fillets do not fit.
void cw_blade_patches(const CwDesign *design, const CwMeridian *meridian, double room, CwBladeShape *shape);

// Makes the guide lines of a seam whose sections are set, those of the blade shifted into the passage. On its way it
// turns into the meridian within a fifth of the angle `room` at either end.
void cw_blade_seam(const CwDesign *design, const CwMeridian *meridian, double room, CwBladeShape *shape);
