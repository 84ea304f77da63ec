// SPDX-License-Identifier: AGPL-3.0-or-later
// Where the inner poles of hub and shroud lie: the walls with the least bending among those between which the passage's
// area is monotone from the eye to D2.
#pragma once

#include "geometry/design.h"

// Sets hub_pole_radial, shroud_pole_axial and shroud_pole_radial of a design whose main dimensions and leading edge on
// the shroud are known: those given (not NAN) as they are, the others solved for to 0.001. Same dimensions, same
// shares.
void cw_meridian_shape(const CwImpellerTable *given, CwDesign *design);
