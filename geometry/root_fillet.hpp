// SPDX-License-Identifier: AGPL-3.0-or-later
// Root fillets: rounds of one radius between blade and hub and blade and shroud, all the way round the blade.
//
//         blade |           A ball of radius R touches wall and blade at the distance L = R / tan(alpha/2) from
//               |           their crease, with the angle alpha between them through the fluid. The fillet is the
//               o B         arc from W to B, tangent to both, as a cubic Bezier in the two directions "out along
//               |\          the wall" and "up the blade": tangent to both surfaces whatever their shape.
//    wall ------+-o-----
//                 W
//
// At corners of the blade's outline (bevel, cut) the feet of both sides meet in a mitre. Towards the trailing
// edge L falls to what has room between D2 and the interface.
#ifndef CUTWATER_GEOMETRY_ROOT_FILLET_HPP
#define CUTWATER_GEOMETRY_ROOT_FILLET_HPP

#include "geometry/blade_patches.hpp"

// Sets foot, reach and handle of all patches of a shape whose points are made. Throws Standard_Failure where
// the fillets of hub and shroud leave too little of the blade between them, or have no room before its leading
// edge.
void cw_root_fillets(const CwDesign *design, const CwMeridian *meridian, CwBladeShape *shape);

#endif
