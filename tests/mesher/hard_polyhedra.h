// SPDX-License-Identifier: AGPL-3.0-or-later
// Those of the hard boundaries that no set of tetrahedra on their corners alone fills, or nearly none: twisted prisms,
// notches, combs and stars.
#pragma once

#include "closed_surfaces.h"

// A maker by its name; *size: the edge length inside, m.
typedef struct {
  const char *name;
  void (*make)(Surface *surface, double *size);
} HardBoundary;

#define HARD(name)                                                                                                     \
  { #name, name }

extern const HardBoundary hard_polyhedra[];
extern const int hard_polyhedra_count;
