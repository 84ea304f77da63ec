// SPDX-License-Identifier: AGPL-3.0-or-later
// Root fillets: rounds between blade and hub and blade and shroud, all the way round the blade.
//
//         blade |           The fillet is the arc from W to B, both at the tangent length of root_fillet_size.h from
//               |           the crease, as a cubic Bezier in the two directions "out along the wall" and "up the
//               o B         blade": tangent to both surfaces whatever their shape.
//               |  .
//    wall ------+---o---
//                   W
//
// At corners of the blade's outline (bevel, cut) the feet of both sides meet in a mitre.
#pragma once

#include "geometry/blade_shape.hpp"
#include "geometry/design.h"

// Sets foot, reach and handle of all patches of a shape whose points are made. Throws std::runtime_error where
// the fillets of hub and shroud leave too little of the blade between them, or have no room before its leading
// edge.
void cw_root_fillets(const CwDesign *design, const CwMeridian *meridian, CwBladeShape *shape);
