// SPDX-License-Identifier: AGPL-3.0-or-later
// Closed boundaries that are hard to fill, all made by formulas, and what a fill of any of them must be.
#ifndef CUTWATER_TESTS_MESHER_HARD_BOUNDARIES_H
#define CUTWATER_TESTS_MESHER_HARD_BOUNDARIES_H

#include "mesher/fill.h"
#include "closed_surfaces.h"

// How many there are; one of them, with its name and the edge length inside, m.
int hard_boundary_count(void);
const char *hard_boundary(int number, Surface *surface, double *size);

// A boundary for each seed: star-shaped bodies, tubes along curves, bodies with voids, extruded polygons and
// boxes, bent, and refined in places. Some cross themselves by chance: those are left to the caller to find.
void random_boundary(uint64_t seed, Surface *surface, double *size);

// Size field of a constant length.
double constant_size(const void *length, const double x[3]);
CwFillInput fill_input(const Surface *surface, const double *size);

// Turns the diagonals of two triangles where that makes none twice, one in `one_in`; gives how many.
int turn_diagonals(Surface *surface, uint64_t seed, int one_in);

// NULL, or what is wrong: the points must be kept, all cells positive (exactly), the open faces the given
// triangles as they are turned, and none more, every point in use, and the volume the enclosed one.
const char *fill_fault(const Surface *surface, const CwFill *fill);

#endif
