// SPDX-License-Identifier: AGPL-3.0-or-later
// Closed boundaries that are hard to fill, all made by formulas.
#pragma once

#include "closed_surfaces.h"

// How many there are; one of them, with its name and the edge length inside, m.
int hard_boundary_count(void);
const char *hard_boundary(int number, Surface *surface, double *size);
