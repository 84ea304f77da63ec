// SPDX-License-Identifier: AGPL-3.0-or-later
// What a finished stator must hold: validity, tolerances, and the angles between its faces.
#pragma once

#include "geometry/solid.hpp"

// Throws std::runtime_error with one line that says what is wrong and where (mm): a vertex with a tolerance
// of 1e-3 model units or more, a face or solid that BRepCheck rejects, two faces that meet through the fluid at less
// than 66 degrees or through the solid at less than 75. Prism layers in sharper places are too skewed.
void cw_stator_check(const CwSolid &stator);
