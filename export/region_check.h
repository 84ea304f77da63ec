// SPDX-License-Identifier: AGPL-3.0-or-later
// What is checked of a whole region before it is written.
#pragma once

#include "export/assembly.h"

typedef struct {
  double volume, least_volume; // m3, of its cells
  CwFaceQuality faces;         // between its cells and on patches
} CwRegionFigures;

// A region that has been checked, and kept where regions that are alike are still to come: those before it, for they
// come backwards. Zeroed to begin with.
typedef struct {
  int region;
  int kept; // 1: `data` is its
  CwRegionData data;
  CwRegionFaces faces;
  CwFlatPrisms flat;
  CwRegionFigures figures;
} CwRegionModel;

// Checks a region; model->faces and model->figures are its own then, until the next call. Where it is a copy of the
// model, turned about the axis (compared cell by cell and point by point), they are those of the model, but for the
// aspect ratios. Else it becomes the model, whose data cw_region_model_keep() takes over once the region is written,
// where others that are alike are to come. Fails with CW_ERR_INPUT, naming file and place, where cw_region_faces()
// does, where a cell has no positive volume, a point belongs to no cell, or the faces are not as many as the assembly
// found.
CwStatus cw_region_check(const CwAssembly *assembly, int region, const CwRegionData *data, CwRegionModel *model);
void cw_region_model_keep(const CwAssembly *assembly, int region, CwRegionData *data, CwRegionModel *model);
void cw_region_model_free(CwRegionModel *model);

// Gives all ranks the figures of all regions, each set on the rank that owns it, and sums them into the totals of the
// domains. Collective.
void cw_region_figures_sum(const CwRanks *ranks, CwRegionFigures *figures, CwAssembly *assembly);
