// SPDX-License-Identifier: AGPL-3.0-or-later
// A boundary for each seed: star-shaped bodies, tubes along curves, bodies with voids, extruded polygons and
// boxes, bent, and refined in places. Some cross themselves by chance: those are left to the caller to find.
#pragma once

#include "closed_surfaces.h"

// size: the edge length inside, m.
void random_boundary(uint64_t seed, Surface *surface, double *size);
