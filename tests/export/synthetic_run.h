// SPDX-License-Identifier: AGPL-3.0-or-later
// A meshed run of a toy pump: an annulus with straight blades as rotor, a wider annulus as stator, in several
// regions, with every patch of a real run. Prisms lie on the two flat walls, tetrahedra between them.
#pragma once

#include "pipeline/mesh/region_items.h"

// One annulus: cells along the radius, around and along the axis (at least 3; the outermost are prisms), and
// the number of regions, divided by planes through the axis.
typedef struct {
  double inner, outer; // m
  int radial, around, axial, regions;
} SyntheticAnnulus;

typedef struct {
  double bottom, top; // m
  SyntheticAnnulus rotor, stator;
  int blades;   // in the rotor, each one cell thick
  int pyramids; // 1: a few cells on the lower wall of the stator are cut into pyramids; they are flat
} SyntheticPump;

// Writes region `number` (1-based) of a domain, of points in m, into the mesh/ of `run`, in a unit of 2 m, so that who
// reads it must bring it to metres. Its digests and the manifest's are seal_run()'s. Returns 0, or -1.
int synthetic_region_write(const char *run, const char *domain, int number, CwRegionData *data);

// A small pump of about 20000 cells in 3 + 2 regions.
SyntheticPump synthetic_pump(void);

// About half as many cells, pyramids among them.
SyntheticPump synthetic_pump_of_all_cells(void);

// Writes mesh/ into the folder `run`, which it makes. Returns 0, or -1 with a
// message on standard error.
int synthetic_run_write(const char *run, const SyntheticPump *pump);
