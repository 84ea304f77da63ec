// SPDX-License-Identifier: AGPL-3.0-or-later
// A solid in another unit, for files that have one of their own. OpenCASCADE's own transformation turns the curves in
// the parameter planes of a scaled solid into splines and rounds them; here points, radii and lengths are multiplied
// and all else stays as it is, so that a factor that is a power of two costs no bit.
#pragma once

#include "geometry/solid.hpp"

// The solid with all lengths times `factor` > 0, and its unit that many times smaller; faces in the same order. It must
// be made of planes, cylinders, cones, surfaces of revolution and B-splines, with a curve on each side of every edge.
// Throws Standard_Failure.
CwSolid cw_solid_scaled(const CwSolid &solid, double factor);
