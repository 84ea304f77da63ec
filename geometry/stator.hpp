// SPDX-License-Identifier: AGPL-3.0-or-later
// For the writers of B-rep and STEP: the solid behind a CwStator, in millimetres.
#ifndef CUTWATER_GEOMETRY_STATOR_HPP
#define CUTWATER_GEOMETRY_STATOR_HPP

#include <TopoDS_Solid.hxx>

#include "geometry/stator.h"

// Lives as long as the stator. Its faces, in the order of TopExp::MapShapes, are those of cw_stator_face_name().
const TopoDS_Solid &cw_stator_solid(const CwStator *stator);

#endif
