// SPDX-License-Identifier: AGPL-3.0-or-later
// What is checked of a whole region before it is written.
#ifndef CUTWATER_EXPORT_REGION_CHECK_H
#define CUTWATER_EXPORT_REGION_CHECK_H

#include "export/assembly.h"

typedef struct {
  double volume, least_volume; // m3, of its cells
  CwFaceQuality faces;         // between its cells and on patches
} CwRegionFigures;

// Matches the faces of the region into `faces` (zeroed on entry, freed by the caller) and measures its cells. Fails
// with CW_ERR_INPUT, naming file and place, where cw_region_faces() does, where a cell has no positive volume, a point
// belongs to no cell, or the faces are not as many as the assembly found.
CwStatus cw_region_check(const CwAssembly *assembly, int region, const CwRegionData *data, CwRegionFaces *faces,
                         CwRegionFigures *figures);

// Gives all ranks the figures of all regions, each set on the rank that owns it, and sums them into the totals of the
// domains. Collective.
void cw_region_figures_sum(const CwRanks *ranks, CwRegionFigures *figures, CwAssembly *assembly);

#endif
