// SPDX-License-Identifier: AGPL-3.0-or-later
// A shape in another unit. OpenCASCADE's own transformation makes the curves in (u,v) anew, off by its rounding and of
// another kind, and takes tolerances for 1e-7 at the least; here points, radii and lengths are multiplied and all else
// stays as it is, so that a factor that is a power of two costs no bit.
#ifndef CUTWATER_PIPELINE_BREP_BREP_SCALE_HPP
#define CUTWATER_PIPELINE_BREP_BREP_SCALE_HPP

#include <TopoDS_Shape.hxx>

// The shape `factor` > 0 times as large about the origin, with its parts in the same order: each number in it is the
// old one or that times the factor, also those of its curves in (u,v). Throws Standard_Failure.
TopoDS_Shape cw_brep_scaled(const TopoDS_Shape &shape, double factor);

#endif
